"""Define the result of a grade, from which every report and export is made."""

from typing import Literal

import msgspec
from msgspec import UNSET, Struct, UnsetType, structs

from grader.protocol import cut
from grader.text import harmless

State = Literal["passed", "not yet", "not started", "waiting", "error"]
Kind = Literal["unit", "property", "scene"]

MAX_JSON = 1_000_000  # bytes of a result; a hundred checks take 30 KB
TEXT_LENGTHS = (2000, 500, 50)  # characters of each text; the first of these that makes it fit
TEXTS = ("ran", "expected", "got", "meaning")
MAX_FILE = 255  # characters of a file's name that are told

FAILED: tuple[State, ...] = ("not yet", "error")  # it ran, and did not pass


class Where(Struct, frozen=True, omit_defaults=True):
    file: str
    line: int
    given: bool = False  # a line of what was handed out, which was changed


class CheckResult(Struct, frozen=True):
    """One check: what ran, what should have come out, and what did."""

    id: str
    title: str
    kind: Kind
    state: State
    points: int
    max_points: int
    ran: str = ""
    expected: str = ""
    got: str = ""
    meaning: str = ""
    where: Where | None = None
    replay: str | None = None
    printed: str | UnsetType = UNSET  # by the submission; told in one's own check alone

    @property
    def failed(self) -> bool:
        """Return whether there is something to say about it."""
        return self.state in FAILED


def in_bounds(check: CheckResult, most: int = TEXT_LENGTHS[0]) -> CheckResult:
    """Return a check with its texts cut to their greatest length: some quote a submission.

    None of them is one that a screen or a terminal obeys, but for the ends of lines.
    """
    names = [*TEXTS, "printed"] if check.printed else TEXTS
    texts = {name: harmless(cut(getattr(check, name), most)) for name in names}
    where = check.where if check.where and len(check.where.file) <= MAX_FILE else None
    return structs.replace(check, where=where, **texts)


def is_bonus(todo: str) -> bool:
    """Return whether a TODO's points are counted apart, by its id: B1, B2 and so on."""
    return todo.startswith("B")


class TodoResult(Struct, frozen=True):
    id: str
    title: str
    state: State
    points: int
    max_points: int
    misconception: str | None
    checks: list[CheckResult]

    @property
    def bonus(self) -> bool:
        """Return whether its points are counted apart from those of the result."""
        return is_bonus(self.id)

    @property
    def failed(self) -> list[CheckResult]:
        """Return the checks that there is something to say about."""
        return [check for check in self.checks if check.failed]

    @property
    def remark(self) -> str:
        """Return why it counts as not started although there is code for it; empty if there is
        none.
        """
        return self.checks[0].meaning if self.checks and self.state == "not started" else ""

    @property
    def notes(self) -> list[str]:
        """Return what is to be said although its checks passed, such as an experiment."""
        passed = [check for check in self.checks if check.state == "passed" and check.meaning]
        return list(dict.fromkeys(check.meaning for check in passed))


class Result(Struct, frozen=True):
    """Schema 1 of the JSON that `--json` writes. `points` and `max_points` are without bonus."""

    schema: int
    submission: str
    points: int
    max_points: int
    bonus: int
    isolation: list[str]
    todos: list[TodoResult]

    def with_todos(self, todos: list[TodoResult]) -> "Result":
        """Return the result with these TODOs for its own, and the points that they add up to."""
        counted = [todo for todo in todos if not todo.bonus]
        return structs.replace(
            self,
            points=sum(todo.points for todo in counted),
            max_points=sum(todo.max_points for todo in counted),
            bonus=sum(todo.points for todo in todos if todo.bonus),
            todos=todos,
        )

    def in_bounds(self) -> "Result":
        """Return the result with texts so short that its JSON has at most MAX_JSON bytes."""
        for most in TEXT_LENGTHS:
            todos = [
                structs.replace(todo, checks=[in_bounds(each, most) for each in todo.checks])
                for todo in self.todos
            ]
            found = structs.replace(self, todos=todos)
            if len(msgspec.json.encode(found)) <= MAX_JSON:
                break
        return found

    @property
    def counted(self) -> list[TodoResult]:
        """Return the TODOs whose points add up to those of the result."""
        return [todo for todo in self.todos if not todo.bonus]

    @property
    def shown(self) -> list[TodoResult]:
        """Return what people are shown: bonus tasks only once begun, or where nothing else was
        asked.
        """
        begun = [todo for todo in self.todos if todo.bonus and todo.state != "not started"]
        return [*self.counted, *begun] if self.counted else self.todos

    @property
    def complete(self) -> bool:
        """Return whether it has full marks or, where only bonus tasks were asked, all of theirs."""
        asked = self.counted or self.todos
        earned = all(todo.points == todo.max_points for todo in asked)
        return earned and self.points == self.max_points


def state_of(checks: list[CheckResult]) -> State:
    """Return "passed" when all checks are; otherwise the most telling of their states."""
    states = {check.state for check in checks}
    order: list[State] = ["error", "not yet", "waiting", "not started"]
    for state in order:
        if state in states:
            return state
    return "passed"
