"""Define the result of a grade, the source of every report and export."""

from typing import Literal

import msgspec
from msgspec import UNSET, Struct, UnsetType, structs

from grader.protocol import cut
from grader.text import defuse

State = Literal["passed", "not yet", "not started", "waiting", "error"]
Kind = Literal["unit", "property", "scene"]

MAX_JSON = 1_000_000  # bytes of a result; a hundred checks take 30 KB
TEXT_LENGTHS = (
    2000,
    500,
    50,
)  # characters of each text: the first with which the result fits
TEXTS = ("ran", "expected", "got", "meaning")
MAX_FILE = 255  # characters of a file's name

FAILED: tuple[State, ...] = ("not yet", "error")  # states of a check that ran and failed


class Where(Struct, frozen=True, omit_defaults=True):
    file: str
    line: int
    given: bool = False  # a changed line of given code


class CheckResult(Struct, frozen=True):
    """The result of one check: the experiment, the expected answer and the one it got."""

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
    printed: str | UnsetType = UNSET  # by the submission; only for the user's own work

    @property
    def failed(self) -> bool:
        return self.state in FAILED


def in_bounds(check: CheckResult, most: int = TEXT_LENGTHS[0]) -> CheckResult:
    """Return a check with short, clean texts, since some quote a submission."""
    names = [*TEXTS, "printed"] if check.printed else TEXTS
    texts = {name: defuse(cut(getattr(check, name), most)) for name in names}
    where = check.where if check.where and len(check.where.file) <= MAX_FILE else None
    return structs.replace(check, where=where, **texts)


def is_bonus(todo: str) -> bool:
    """Return whether a TODO is a bonus task, by its id: B1, B2 and so on."""
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
        """Return whether it is a bonus task, whose points count apart."""
        return is_bonus(self.id)

    @property
    def failed(self) -> list[CheckResult]:
        return [check for check in self.checks if check.failed]

    @property
    def remark(self) -> str:
        """Return the reason why it counts as not started although it has code, or an empty text."""
        return self.checks[0].meaning if self.checks and self.state == "not started" else ""

    @property
    def notes(self) -> list[str]:
        """Return the sentences about checks that passed, such as an experiment."""
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
        """Return the result with these TODOs and the sum of their points."""
        counted = [todo for todo in todos if not todo.bonus]
        return structs.replace(
            self,
            points=sum(todo.points for todo in counted),
            max_points=sum(todo.max_points for todo in counted),
            bonus=sum(todo.points for todo in todos if todo.bonus),
            todos=todos,
        )

    def in_bounds(self) -> "Result":
        """Return the result with texts short enough for a JSON of at most MAX_JSON bytes."""
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
    def main_todos(self) -> list[TodoResult]:
        """Return the TODOs whose points add up to the result's points."""
        return [todo for todo in self.todos if not todo.bonus]

    @property
    def todos_to_show(self) -> list[TodoResult]:
        """Return the TODOs for reports: bonus tasks once started, or if there is nothing else."""
        begun = [todo for todo in self.todos if todo.bonus and todo.state != "not started"]
        return [*self.main_todos, *begun] if self.main_todos else self.todos

    @property
    def has_full_marks(self) -> bool:
        """Return whether it has full marks; bonus tasks count only if nothing else was graded."""
        asked = self.main_todos or self.todos
        earned = all(todo.points == todo.max_points for todo in asked)
        return earned and self.points == self.max_points


def state_of(checks: list[CheckResult]) -> State:
    """Return "passed" if all checks passed, otherwise their most important state."""
    states = {check.state for check in checks}
    order: list[State] = ["error", "not yet", "waiting", "not started"]
    for state in order:
        if state in states:
            return state
    return "passed"
