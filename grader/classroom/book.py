"""What is kept of a graded class.

- `DIR/NAME.json`: the result of each submission, byte for byte what `--json` writes.
- `DIR.class.jsonl`: the class book, a line for each submission. A line is added as soon as a result
  is written, so a run that was killed goes on where it stopped.
- `DIR.class.csv`: the table, for people.
"""

import hashlib
from collections.abc import Iterable, Iterator
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Self

import msgspec
from msgspec import Struct

from grader.classroom.adjustments import timestamp
from grader.judge.course import FULL, Course
from grader.judge.result import Result, is_bonus
from grader.report.files import write_whole
from grader.report.sinks.tables import as_csv

NOTHING = "nothing was handed in"


class Outcome(Struct, frozen=True):
    """One submission of a class: its points, or why there are none."""

    name: str
    trouble: str = ""
    points: int = 0
    max_points: int = 0
    todos: dict[str, int] = {}  # points by TODO
    left: list[str] = []  # TODOs that are not passed
    final: int = 0  # points after adjustments
    reasons: list[str] = []  # of the adjustments
    late: bool = False
    handed_in: datetime | None = None
    seconds: float = 0.0  # that grading took
    graded: datetime | None = None
    key: str = ""  # the hash of all that the result depends on
    content: str = ""  # the hash of the result's file
    bonus_by_hand: int = 0  # beside what was graded
    by_hand: bool = False  # the final points were set by a person, whatever was graded
    due: datetime | None = None  # for this student
    notes: list[str] = []  # what taking it in has to say
    broken: list[str] = []  # programs that cannot be imported, and why
    group: list[str] = []  # the others whose work this is too
    handed_in_by: str = ""  # one of them, where it was not this student

    @property
    def group_in_words(self) -> str:
        """Who did this together; empty for who worked alone."""
        by = f", handed in by {self.handed_in_by}" if self.handed_in_by else ""
        return f"group with {' and '.join(self.group)}{by}" if self.group else ""

    @property
    def mark(self) -> int | None:
        """The points that count; None where a person must look first."""
        return self.final if self.by_hand or not self.trouble else None

    @property
    def bonus(self) -> int:
        """The points of bonus tasks and those that a person gave as such, all of them."""
        graded = sum(points for todo, points in self.todos.items() if is_bonus(todo))
        return graded + self.bonus_by_hand


class Book:
    """The results of a class in a folder, and the book beside it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self.path = self.folder.with_name(f"{self.folder.name}.class.jsonl")
        self.table = self.path.with_suffix(".csv")
        self.known = {each.name: each for each in read_book(self.path)}

    def __enter__(self) -> Self:
        self.folder.mkdir(parents=True, exist_ok=True)
        for part in self.folder.glob(f".*.json.{'[0-9a-f]' * 16}"):
            part.unlink()  # of a run that was killed
        write_whole(lines(self.known.values()), self.path)  # a line may be half there
        self.file = open(self.path, "ab", buffering=0)
        return self

    def __exit__(self, *_: object) -> None:
        self.file.close()

    def result_file(self, name: str) -> Path:
        return self.folder / f"{name}.json"

    def kept(self, name: str, key: str) -> Outcome | None:
        """What stands from an earlier run, if nothing has changed and the result is untouched."""
        known = self.known.get(name)
        if known is None or known.key != key:
            return None
        with suppress(OSError):
            if hashlib.sha256(self.result_file(name).read_bytes()).hexdigest() == known.content:
                return known
        return None

    def write(self, outcome: Outcome, result: bytes) -> None:
        """The result first: a line in the book promises that it is there."""
        write_whole(result, self.result_file(outcome.name))
        self.file.write(lines([outcome]))

    def forget(self, name: str) -> None:
        """No result may outlive the submission that it was made from."""
        self.result_file(name).unlink(missing_ok=True)

    def close_with(self, outcomes: list[Outcome], course: Course = FULL) -> None:
        """The book and the table as they are at the end."""
        write_whole(lines(outcomes), self.path)
        write_whole(as_table(outcomes, course).encode("utf-8-sig"), self.table)

    def others_than(self, names: Iterable[str]) -> list[str]:
        """Results in the folder that belong to no submission of this class."""
        return sorted({path.stem for path in self.folder.glob("[!.]*.json")} - set(names))


def outcome_of(name: str, result: bytes, seconds: float, key: str) -> Outcome:
    """What the book says about a result."""
    decoded = msgspec.json.decode(result, type=Result)
    return Outcome(
        name,
        points=decoded.points,
        max_points=decoded.max_points,
        todos={todo.id: todo.points for todo in decoded.todos},
        left=[todo.id for todo in decoded.counted if todo.state != "passed"],
        final=decoded.points,
        seconds=round(seconds, 3),
        graded=datetime.now(UTC).replace(microsecond=0),
        key=key,
        content=hashlib.sha256(result).hexdigest(),
        broken=not_imported(decoded),
    )


def not_imported(result: Result) -> list[str]:
    """The programs whose every point is lost before the first question is asked, and why."""
    lost: dict[str, str] = {}
    for todo in result.counted:
        for check in todo.checks:
            if check.state == "error" and check.ran.startswith("import "):
                lost.setdefault(check.ran, check.got.partition("\n")[0][:100])
    return [f"{ran} fails: {why}" for ran, why in lost.items()]


def lines(outcomes: Iterable[Outcome]) -> bytes:
    return b"".join(msgspec.json.encode(each) + b"\n" for each in outcomes)


def read_book(path: Path) -> Iterator[Outcome]:
    """The lines of a book; of one that was cut off, those that are whole."""
    if path.exists():
        with open(path, "rb") as file:
            for line in file:
                with suppress(msgspec.MsgspecError):
                    yield msgspec.json.decode(line, type=Outcome)


def as_table(outcomes: Iterable[Outcome], course: Course) -> str:
    """The class for a spreadsheet: nothing in it depends on when or how fast it was graded."""
    todos = [todo.id for todo in course.rubric.todos]
    titles = ["name", "points", "found", "of", "bonus", "handed in", "due", "late", "adjusted"]
    table: list[list[str | float]] = [[*titles, "trouble", "notes", "group", *todos]]
    for each in outcomes:
        mark = "" if each.mark is None else each.mark
        found = ["", each.max_points or ""] if each.trouble else [each.points, each.max_points]
        bonus = each.bonus if each.mark is not None else ""
        times = [timestamp(when) if when else "" for when in (each.handed_in, each.due)]
        late = "late" if each.late else ""
        words = [late, "; ".join(each.reasons), each.trouble, "; ".join(each.notes)]
        points = [str(each.todos.get(todo, "")) for todo in todos]
        table.append([each.name, mark, *found, bonus, *times, *words, each.group_in_words, *points])
    return as_csv(table)
