"""Write tables with a line per check: CSV for spreadsheets, JSON Lines for programs."""

from collections.abc import Iterable, Iterator

import msgspec

from grader.judge.result import Result
from grader.judge.wording import place_of
from grader.text import clean, format_csv


def write_csv(results: Iterable[Result]) -> bytes:
    """Return a line per check, as Excel reads it: UTF-8 with its mark, CRLF."""
    rows = list(make_rows(results))
    return format_csv([rows[0], *(row.values() for row in rows)]).encode("utf-8-sig")


def write_json_lines(results: Iterable[Result]) -> bytes:
    """Return an object per check, without the escapes for spreadsheets."""
    return b"".join(msgspec.json.encode(row) + b"\n" for row in make_rows(results))


def make_rows(results: Iterable[Result]) -> Iterator[dict[str, str | int]]:
    """Yield a row per check, also of bonus tasks."""
    for result in results:
        for todo in result.todos:
            for check in todo.checks:
                yield {
                    "submission": clean(result.submission),
                    "todo": todo.id,
                    "check": check.id,
                    "kind": check.kind,
                    "state": check.state,
                    "points": check.points,
                    "max_points": check.max_points,
                    "misconception": clean(todo.misconception or ""),
                    "expected": clean(check.expected),
                    "got": clean(check.got),
                    "where": clean(place_of(check)),
                }
