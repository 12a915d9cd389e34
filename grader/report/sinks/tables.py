"""Write plain tables: CSV for spreadsheets and JSON Lines for programs, a line per check."""

from collections.abc import Iterable, Iterator

import msgspec

from grader.judge.result import Result
from grader.judge.wording import place_of
from grader.text import clean, format_csv

COLUMNS = (
    "submission",
    "todo",
    "check",
    "kind",
    "state",
    "points",
    "max_points",
    "misconception",
    "expected",
    "got",
    "where",
)


def write_csv(results: Iterable[Result]) -> bytes:
    """Return a line per check, as Excel and all others read it: UTF-8 with its mark, CRLF."""
    table = [COLUMNS, *(row.values() for row in make_rows(results))]
    return format_csv(table).encode("utf-8-sig")


def write_json_lines(results: Iterable[Result]) -> bytes:
    """Return an object per check, with no value changed for spreadsheets."""
    return b"".join(msgspec.json.encode(row) + b"\n" for row in make_rows(results))


def make_rows(results: Iterable[Result]) -> Iterator[dict[str, str | int]]:
    """Return a row per check, also of bonus TODOs, whose ids begin with a B."""
    for result in results:
        for todo in result.todos:
            for check in todo.checks:
                values = (
                    clean(result.submission),
                    todo.id,
                    check.id,
                    check.kind,
                    check.state,
                    check.points,
                    check.max_points,
                    clean(todo.misconception or ""),
                    clean(check.expected),
                    clean(check.got),
                    clean(place_of(check)),
                )
                yield dict(zip(COLUMNS, values, strict=True))
