"""Write the result of one submission as a page that needs no network and no other file."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from grader.judge.result import Result, TodoResult
from grader.judge.wall.isolation import list_unconfined
from grader.judge.wording import list_reasons
from grader.player.page import clean_line, fill_template
from grader.report.files import write_whole
from grader.report.terminal import group_checks
from grader.text import defuse

TEMPLATES = Path(__file__).with_name("templates")
MAX_EMBEDDED = 8_000_000  # characters of replays in one page; further ones become links


@dataclass(frozen=True)
class Remark:
    """A person's comment to a student, beside the lines of code that it is about."""

    comment: str
    file: str = ""
    line: int = 0  # 0: about no line, or the line was not found
    code: list[tuple[int, str]] = field(default_factory=list)  # numbered lines around it
    note: str = ""  # on a line that was changed or not found

    @property
    def place(self) -> str:
        return f"{self.file}, line {self.line}" if self.line else self.file


@dataclass(frozen=True)
class Standing:
    """A student's final mark, and its reasons in named lines."""

    name: str
    mark: int | None  # None: it needs manual review
    max_points: int
    bonus: int = 0  # shown beside the mark if it does not count
    scaled: str = ""  # the mark on the gradebook's scale, if that differs
    lines: list[tuple[str, str]] = field(default_factory=list)
    comments: list[Remark] = field(default_factory=list)


def write_report(result: Result | None, path: Path, standing: Standing | None = None) -> None:
    """Write the page, with the replays from its folder; without a result, only the standing."""
    if result is None:
        page = fill_template(
            TEMPLATES / "standing.html",
            "report.css",
            standing=standing,
            clean=clean_line,
            harmless=defuse,
        )
    else:
        page = render(result, find_replays(result, path.parent), standing)
    write_whole(page.encode("utf-8"), path)


def render(result: Result, replays: Mapping[str, str], standing: Standing | None = None) -> str:
    """Return the page, with these `replays` embedded; they are named by path."""
    return fill_template(
        TEMPLATES / "report.html",
        "report.css",
        has_replays=True,
        result=result,
        todos=list_failed_first(result),
        replays=replays,
        standing=standing,
        unconfined=list_unconfined(result.isolation),
        clean=clean_line,
        harmless=defuse,
        reasons=list_reasons,
        repeated=find_repeated(result),
    )


def find_repeated(result: Result) -> set[tuple[str, str]]:
    """Return the TODO and check of each failure whose reason an earlier check of the TODO shows."""
    return {
        (todo.id, check.id)
        for todo in result.todos_to_show
        for first, *others in group_checks(todo.failed)
        for check in others
    }


def list_failed_first(result: Result) -> list[TodoResult]:
    """Return the TODOs, with passed ones last."""
    return sorted(result.todos_to_show, key=lambda todo: todo.state == "passed")


def find_replays(result: Result, folder: Path) -> dict[str, str]:
    """Return the existing replays that fit into one page, by path."""
    found: dict[str, str] = {}
    room = MAX_EMBEDDED
    for name in (check.replay for todo in result.todos for check in todo.checks):
        file = folder / name if name else None
        if name and file and file.is_file() and file.stat().st_size <= room:
            found[name] = file.read_text(encoding="utf-8")
            room -= len(found[name])
    return found
