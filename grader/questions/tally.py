"""Count how often classes answered questions rightly, in a small file, and write its page."""

import hashlib
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.judge.submission import CannotGrade
from grader.questions.marking import Mark
from grader.questions.page import fill_page
from grader.questions.question import KINDS, Question, Sheet
from grader.report.files import write_whole


class Count(Struct):
    """The answers to one question of a class: how many, how many right, and known wrong ones."""

    answered: int = 0
    right: int = 0
    wrong: dict[str, int] = {}


Tally = dict[str, dict[str, Count]]  # by class and by the question's name


def read_tally(path: Path) -> Tally:
    """Read the file; return nothing where there is none yet."""
    if not path.is_file():
        return {}
    try:
        return msgspec.json.decode(path.read_bytes(), type=Tally)
    except (OSError, msgspec.DecodeError) as error:
        raise CannotGrade(f"{path} is no tally of answers: move it away") from error


def add_class(path: Path, sheets: Iterable[Sheet], marks: Iterable[Mark]) -> Tally:
    """Add the marks of a class; a class that is marked again replaces its own entry."""
    tally = read_tally(path)
    names = sorted(f"{sheet.seed}/{sheet.student}" for sheet in sheets)
    tally[hashlib.sha256("\n".join(names).encode()).hexdigest()[:16]] = count_answers(marks)
    write_whole(msgspec.json.format(msgspec.json.encode(tally)) + b"\n", path)
    return tally


def count_answers(marks: Iterable[Mark]) -> dict[str, Count]:
    """Count the answers by question, except those that nobody gave or could read."""
    found: dict[str, Count] = {}
    for each in marks:
        if each.points is None or not each.answer:
            continue
        count = found.setdefault(each.question.name, Count())
        count.answered += 1
        count.right += each.right
        if not each.right and each.note:
            count.wrong[each.note] = count.wrong.get(each.note, 0) + 1
    return found


@dataclass(frozen=True)
class Row:
    """A question on the instructor's page: an example, and the answers of classes."""

    example: Question
    classes: int
    answered: int
    right: int
    wrong: list[tuple[str, int]]

    @property
    def share(self) -> str:
        return f"{self.right / self.answered:.0%}" if self.answered else "-"


def make_rows(sheets: Sequence[Sheet], tally: Tally) -> Iterator[Row]:
    examples = {each.name: each for sheet in reversed(sheets) for each in sheet.questions}
    order = list(KINDS)
    for name in sorted(examples, key=lambda each: (order.index(examples[each].kind), each)):
        counts = [each[name] for each in tally.values() if name in each]
        answered = sum(each.answered for each in counts)
        right = sum(each.right for each in counts)
        wrong = sum((Counter(each.wrong) for each in counts), Counter[str]())
        yield Row(examples[name], len(counts), answered, right, wrong.most_common(5))


def write_bank(path: Path, sheets: Sequence[Sheet], tally: Tally) -> None:
    """Write the instructor's page of all questions that these sheets have."""
    page = fill_page("bank.html", rows=list(make_rows(sheets, tally)))
    write_whole(page.encode("utf-8"), path)
