"""Plain tables: CSV for spreadsheets and JSON Lines for programs, a line per check."""

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


def csv_table(results: Iterable[Result]) -> bytes:
    """A line per check, as Excel and all others read it: UTF-8 with its mark, CRLF."""
    table = [COLUMNS, *(row.values() for row in rows(results))]
    return format_csv(table).encode("utf-8-sig")


def json_lines(results: Iterable[Result]) -> bytes:
    """An object per check; no value is changed for a spreadsheet's sake."""
    return b"".join(msgspec.json.encode(row) + b"\n" for row in rows(results))


def rows(results: Iterable[Result]) -> Iterator[dict[str, str | int]]:
    """Bonus TODOs have lines as well: their names begin with a B."""
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
