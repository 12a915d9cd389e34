"""The result of one submission as a page that needs nothing else: no network, no second file."""

from collections.abc import Mapping
from pathlib import Path

from markupsafe import Markup

from grader.judge.isolation import unconfined
from grader.judge.result import Result
from grader.player.page import allowed, environment, hashes, one_line, theme
from grader.report.files import write_whole
from grader.words import named_reasons

TEMPLATES = Path(__file__).with_name("templates")
MAX_EMBEDDED = 8_000_000  # characters of replays in one page; the others are linked to


def write_report(result: Result, path: Path, folder: Path | None = None) -> None:
    """Write the page; replays are looked for in `folder`, or else beside the page."""
    replays = found_replays(result, folder or path.parent)
    write_whole(report(result, replays).encode("utf-8"), path)


def report(result: Result, replays: Mapping[str, str]) -> str:
    """The page; `replays` are the pages to embed, by their paths in the result."""
    style = theme() + (TEMPLATES / "report.css").read_text(encoding="utf-8")
    player_style, player_script = hashes()
    return (
        environment(TEMPLATES)
        .get_template("report.html")
        .render(
            result=result,
            replays=replays,
            unconfined=unconfined(result.isolation),
            clean=one_line,
            reasons=named_reasons,
            style=Markup(style),
            style_hashes=f"'{allowed(style)}' '{player_style}'",
            script_hash=f"'{player_script}'",
        )
    )


def found_replays(result: Result, folder: Path) -> dict[str, str]:
    """The replays that are there, as far as they fit into one page."""
    found: dict[str, str] = {}
    room = MAX_EMBEDDED
    for name in (check.replay for todo in result.todos for check in todo.checks):
        file = folder / name if name else None
        if name and file and file.is_file() and file.stat().st_size <= room:
            found[name] = file.read_text(encoding="utf-8")
            room -= len(found[name])
    return found
