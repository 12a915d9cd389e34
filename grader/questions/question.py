"""Define a question of any kind, and read an answer to it."""

import re
from typing import Literal

from msgspec import Struct

Kind = Literal["number", "film", "why"]
KINDS: dict[Kind, str] = {
    "number": "predict a number",
    "film": "predict a film",
    "why": "say why",
}
NUMBER = re.compile(r"[-+]?(\d+([.,]\d*)?|[.,]\d+)(e[-+]?\d+)?", re.IGNORECASE)


class Wrong(Struct, frozen=True):
    """A common wrong answer, and the misunderstanding behind it."""

    answer: str
    why: str


class Picture(Struct, frozen=True):
    """A drawing as SVG, with words for those who cannot see it."""

    name: str  # of its file, without an ending
    alt: str
    svg: str


class Question(Struct, frozen=True):
    """One question with its key.

    `text` has one paragraph per line, and code between backticks. `answer` is a number, or for
    films the letters of the choices in the order of the films. A person marks a `why`, by its
    rubric.
    """

    name: str  # name of its maker, such as "impulse"
    kind: Kind
    todos: tuple[str, ...]  # that it is about
    text: str
    points: int
    answer: str = ""
    tolerance: float = 0.0  # of a number, either way
    unit: str = ""
    wrong: tuple[Wrong, ...] = ()
    why: str = ""  # explanation of the answer, for the key
    code: str = ""  # a line of the student's own
    choices: tuple[str, ...] = ()  # of films: the changes, named a, b, c and so on
    pictures: tuple[Picture, ...] = ()
    rubric: tuple[str, ...] = ()  # a point each, for marking by hand

    @property
    def by_hand(self) -> bool:
        return self.kind == "why"


class Sheet(Struct, frozen=True):
    """The questions of one student, and the ones that could not be asked."""

    student: str
    seed: str  # to make it again
    questions: tuple[Question, ...]
    dropped: tuple[str, ...] = ()  # a sentence for each question that could not be asked
    full_name: str = ""  # of the student, as the class list has it

    @property
    def label(self) -> str:
        """Return the student's name as people know it."""
        return f"{self.full_name} ({self.student})" if self.full_name else self.student

    @property
    def points(self) -> int:
        return sum(each.points for each in self.questions)


class Unreadable(Exception):
    """Raised if an answer cannot be read; the message says what was expected."""


def grade_answer(question: Question, answer: str) -> int:
    """Return the points that an answer earns without a person; raises Unreadable."""
    text = answer.strip()
    match question.kind:
        case "number":
            right = abs(parse_number(text, question.unit) - float(question.answer))
            return question.points * (right <= question.tolerance)
        case "film":
            letters, count = re.sub(r"[\s,;/-]", "", text).lower(), len(question.answer)
            if not re.fullmatch(rf"[a-z]{{{count}}}", letters):
                raise Unreadable(f"“{text[:40]}” is not {count} letters, one for each film in turn")
            right = sum(map(str.__eq__, letters, question.answer))
            return question.points * right // count
        case "why":
            return 0


def parse_number(text: str, unit: str = "") -> float:
    """Read the one number of an answer, with a point or a comma, with or without its unit."""
    rest = text.removesuffix(unit).strip() if unit else text
    plain = rest.replace("\u2212", "-").replace(" ", "")
    if re.fullmatch(r"[-+]?[1-9]\d{0,2},\d{3}", plain):
        raise Unreadable(f"“{text[:40]}” may be a whole number or not: write it without a comma")
    if not NUMBER.fullmatch(plain):
        unit_too = f", or 3.5 {unit}" if unit else ""
        raise Unreadable(f"“{text[:40]}” is not one number, such as 3.5{unit_too}")
    return float(plain.replace(",", "."))


def find_misunderstanding(question: Question, answer: str) -> str:
    """Return the misunderstanding behind a wrong answer, if it is known."""
    try:
        given = parse_number(answer.strip(), question.unit)
        off = [abs(given - float(each.answer)) for each in question.wrong]
    except (Unreadable, ValueError):
        return ""
    known = zip(question.wrong, off, strict=True)
    return next((each.why for each, by in known if by <= question.tolerance), "")
