"""Store a graded class in files.

- `DIR/NAME.json`: the result of each submission, byte for byte what `--json` writes.
- `DIR.class.jsonl`: the class book, a line for each submission. Each result adds its line at
  once, so a killed run continues where it stopped.
- `DIR.class.csv`: the table, for people.
- `DIR.earlier/NAME/`: the results that a later grade replaced.
"""

import hashlib
from collections.abc import Iterable, Iterator
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Self

import msgspec
from msgspec import Struct

from grader.classroom.adjustments import write_time
from grader.intake.names import sort_key
from grader.judge.course import FULL, Course
from grader.judge.result import Result, TodoResult, is_bonus
from grader.report.files import write_whole
from grader.report.html import Remark
from grader.text import format_csv

NOTHING = "nothing was handed in"


class Outcome(Struct, frozen=True):
    """A submission of a class: its points, or the reason why it has none."""

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
    seconds: float = 0.0  # s that grading took
    graded: datetime | None = None
    key: str = ""  # the hash of all that the result depends on
    content: str = ""  # the hash of the result's file
    bonus_by_hand: int = 0  # beside what was graded
    by_hand: bool = False  # a person set the final points
    due: datetime | None = None  # for this student
    notes: list[str] = []  # notes on the files that were handed in
    broken: list[str] = []  # programs that cannot be imported, and why
    group: list[str] = []  # the other owners of this work
    handed_in_by: str = ""  # the one who handed in, if not this student
    full_name: str = ""  # as the class list has it
    before: str = ""  # the mark of an earlier run, if it differs
    changed: list[str] = []  # the checks whose points differ from that run
    remarks: list[Remark] = []  # a person's comments

    @property
    def label(self) -> str:
        """Return `full name (name)`, or the name alone."""
        return f"{self.full_name} ({self.name})" if self.full_name else self.name

    @property
    def order(self) -> tuple[object, str]:
        """Return the sort key: full name, then name."""
        return sort_key(self.full_name or self.name), self.name

    @property
    def group_in_words(self) -> str:
        """Return the group in words; empty for a student who worked alone."""
        by = f", handed in by {self.handed_in_by}" if self.handed_in_by else ""
        return f"group with {' and '.join(self.group)}{by}" if self.group else ""

    def explain(self) -> str:
        """Return the group, and the reasons for points other than the checks'."""
        return "; ".join(filter(None, [self.group_in_words, self.trouble, *self.reasons]))

    @property
    def mark_in_words(self) -> str:
        return "none" if self.mark is None else f"{self.mark} / {self.max_points}"

    def has_mark_of(self, old: "Outcome") -> bool:
        """Return whether mark and maximum equal another outcome's."""
        alone = self.by_hand or self.mark is None  # its maximum is set later
        return self.mark == old.mark and (alone or self.max_points == old.max_points)

    @property
    def changes(self) -> list[str]:
        """Return the mark before and the checks that changed, a line each."""
        return [f"before: {self.before}", *self.changed] if self.before else []

    @property
    def mark(self) -> int | None:
        """Return the points that count; None if it needs manual review."""
        return self.final if self.by_hand or not self.trouble else None

    @property
    def bonus(self) -> int:
        """Return the points of bonus tasks, and bonus points that a person gave."""
        graded = sum(points for todo, points in self.todos.items() if is_bonus(todo))
        return graded + self.bonus_by_hand


class Book:
    """The results of a class in a folder, and the book beside it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self.path = self.folder.with_name(f"{self.folder.name}.class.jsonl")
        self.table = self.path.with_suffix(".csv")
        self.earlier = self.folder.with_name(f"{self.folder.name}.earlier")
        self.outcomes = {each.name: each for each in read_book(self.path)}

    def __enter__(self) -> Self:
        self.folder.mkdir(parents=True, exist_ok=True)
        for part in self.folder.glob(f".*.json.{'[0-9a-f]' * 16}"):
            part.unlink()  # of a run that was killed
        write_whole(encode_lines(self.outcomes.values()), self.path)  # the last line may be cut off
        self.file = open(self.path, "ab", buffering=0)
        return self

    def __exit__(self, *_: object) -> None:
        self.file.close()

    def locate_result(self, name: str) -> Path:
        return self.folder / f"{name}.json"

    def find_kept(self, name: str, key: str) -> Outcome | None:
        """Return the outcome of an earlier run, if nothing has changed since then."""
        outcome = self.outcomes.get(name)
        if outcome is None or outcome.key != key:
            return None
        with suppress(OSError):
            content = self.locate_result(name).read_bytes()
            if hashlib.sha256(content).hexdigest() == outcome.content:
                return outcome
        return None

    def compare(self, outcome: Outcome, result: bytes) -> Outcome:
        """Return the outcome with the checks that changed since an earlier run."""
        with suppress(OSError, msgspec.MsgspecError):
            old = msgspec.json.decode(self.locate_result(outcome.name).read_bytes(), type=Result)
            new = msgspec.json.decode(result, type=Result)
            return msgspec.structs.replace(outcome, changed=list(compare_results(old, new)))
        return outcome

    def compare_marks(self, outcome: Outcome) -> Outcome:
        """Return the outcome with the mark of an earlier run, if it differs."""
        old = self.outcomes.get(outcome.name)
        if old is None or outcome.has_mark_of(old):
            return outcome
        fresh = outcome.content != old.content
        changed = outcome.changed if fresh else []
        return msgspec.structs.replace(outcome, before=old.mark_in_words, changed=changed)

    def keep_earlier(self, name: str) -> None:
        """Move a result into `earlier`, which stores equal results once."""
        path = self.locate_result(name)
        if not path.exists():
            return
        old = self.outcomes.get(name)
        when = old.graded if old else None
        digest = hashlib.sha256(path.read_bytes()).hexdigest()[:8]
        title = f"{when:%Y-%m-%dT%H%M%S}-{digest}" if when else digest
        target = self.earlier / name / f"{title}.json"
        target.parent.mkdir(parents=True, exist_ok=True)
        path.replace(target)

    def write(self, outcome: Outcome, result: bytes) -> None:
        """Write the result, then its line: a line means that the result exists."""
        self.keep_earlier(outcome.name)
        write_whole(result, self.locate_result(outcome.name))
        self.file.write(encode_lines([outcome]))

    def finish(self, outcomes: list[Outcome], course: Course = FULL) -> None:
        write_whole(encode_lines(outcomes), self.path)
        write_whole(make_table(outcomes, course).encode("utf-8-sig"), self.table)


def make_outcome(name: str, result: bytes, seconds: float, key: str) -> Outcome:
    """Return the line of the book for a result."""
    decoded = msgspec.json.decode(result, type=Result)
    return Outcome(
        name,
        points=decoded.points,
        max_points=decoded.max_points,
        todos={todo.id: todo.points for todo in decoded.todos},
        left=[todo.id for todo in decoded.main_todos if todo.state != "passed"],
        final=decoded.points,
        seconds=round(seconds, 3),
        graded=datetime.now(UTC).replace(microsecond=0),
        key=key,
        content=hashlib.sha256(result).hexdigest(),
        broken=list_broken(decoded),
    )


def compare_results(old: Result, new: Result) -> Iterator[str]:
    """Yield the TODOs whose maximum changed, and the checks whose points changed."""
    before = {todo.id: todo for todo in old.todos}
    for todo in new.todos:
        was = before.pop(todo.id, None)
        if was is None:
            yield f"TODO {todo.id} is new: {todo.points} of {todo.max_points}"
        else:
            yield from compare_todos(was, todo)
    for todo in before.values():
        yield f"TODO {todo.id} is not asked any more: it had {todo.points} of {todo.max_points}"


def compare_todos(old: TodoResult, new: TodoResult) -> Iterator[str]:
    """Yield the changes; omit a check if only its maximum changed."""
    if old.max_points != new.max_points:
        points = f"{old.points} of {old.max_points} → {new.points} of {new.max_points}"
        yield f"TODO {new.id} has other points in the course: {points}"
    before = {check.id: check for check in old.checks}
    for check in new.checks:
        was = before.get(check.id)
        if was is None or (was.max_points != check.max_points and was.state == check.state):
            continue
        if was.points != check.points:
            points = f"{was.points} → {check.points} of {check.max_points}"
            yield f"TODO {new.id}, {check.title}: {points}"


def list_broken(result: Result) -> list[str]:
    lost: dict[str, str] = {}
    for todo in result.main_todos:
        for check in todo.checks:
            if check.state == "error" and check.ran.startswith("import "):
                lost.setdefault(check.ran, check.got.partition("\n")[0][:100])
    return [f"{ran} fails: {why}" for ran, why in lost.items()]


def encode_lines(outcomes: Iterable[Outcome]) -> bytes:
    return b"".join(msgspec.json.encode(each) + b"\n" for each in outcomes)


def read_book(path: Path) -> Iterator[Outcome]:
    """Yield the complete lines of a book."""
    if path.exists():
        with open(path, "rb") as file:
            for line in file:
                with suppress(msgspec.MsgspecError):
                    yield msgspec.json.decode(line, type=Outcome)


def make_table(outcomes: Iterable[Outcome], course: Course) -> str:
    """Return the class for a spreadsheet, without times of grading.

    `points` count; `found` are the points of the checks before adjustments, out of `of`.
    """
    todos = [todo.id for todo in course.rubric.todos]
    titles = ["name", "student", "points", "before", "found", "of", "bonus", "handed in", "due"]
    titles += ["late", "adjusted", "trouble", "notes", "group"]
    table: list[list[str | float]] = [[*titles, *todos]]
    for each in outcomes:
        mark = "" if each.mark is None else each.mark
        found = ["", each.max_points or ""] if each.trouble else [each.points, each.max_points]
        bonus = each.bonus if each.mark is not None else ""
        times = [write_time(when) for when in (each.handed_in, each.due)]
        late = "late" if each.late else ""
        words = [late, "; ".join(each.reasons), each.trouble, "; ".join(each.notes)]
        points = [str(each.todos.get(todo, "")) for todo in todos]
        who = [each.name, each.full_name, mark, each.before]
        table.append([*who, *found, bonus, *times, *words, each.group_in_words, *points])
    return format_csv(table)
