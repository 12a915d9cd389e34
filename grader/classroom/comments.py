"""Place a person's comments on lines of code, and find these lines again in a later submission.

A comment keeps the text of its line and of both neighbours. So it follows a line that moves, or
that changes between the same neighbours.
"""

from collections.abc import Mapping
from itertools import accumulate
from pathlib import PurePosixPath
from typing import Annotated

from msgspec import Meta, Struct

from grader.report.html import Remark

AROUND = 2  # lines shown before and after the commented one
LONGEST_LINE = 500  # letters of a line to compare, keep and show

Words = Annotated[str, Meta(pattern=r"\S")]


class Comment(Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """A comment to a student, on a line of a file or on all of the work."""

    student: Words
    comment: Words
    file: str = ""
    line: Annotated[int, Meta(ge=0)] = 0  # its number when the comment was written
    code: str = ""  # the line's text
    above: str = ""  # the line before it that is not empty
    below: str = ""


def place_comment(comment: Comment, files: Mapping[str, bytes]) -> Remark:
    """Return the comment with its lines as the files have them now."""
    if not comment.file:
        return Remark(comment.comment)
    name = find_file(comment.file, files)
    lines = read_lines(files[name]) if name else []
    number = find_line(comment, lines)
    if not number:
        words = f"this line was not found in this submission: {comment.code.strip()}"
        return Remark(comment.comment, comment.file, note=words)
    first = max(0, number - 1 - AROUND)
    shown = list(enumerate(lines[first : number + AROUND], first + 1))
    changed = comment.code and comment.code.strip() != lines[number - 1].strip()
    note = f"the line has changed; it was: {comment.code.strip()}" if changed else ""
    return Remark(comment.comment, name, number, shown, note)


def find_file(name: str, files: Mapping[str, bytes]) -> str:
    """Return the path of the only file of this name, or an empty text."""
    last = PurePosixPath(name).name
    found = [name] if name in files else [e for e in files if PurePosixPath(e).name == last]
    return found[0] if len(found) == 1 else ""


def split_lines(content: bytes) -> list[str]:
    return [line.rstrip("\r") for line in content.decode("utf-8-sig", "replace").split("\n")]


def read_lines(content: bytes) -> list[str]:
    """Return the lines of a file, long ones cut."""
    return [line[:LONGEST_LINE] for line in split_lines(content)]


def find_line(comment: Comment, lines: list[str]) -> int:
    """Return the number of the commented line; 0 if it is uncertain.

    A line of the same text counts if it is the only one or has one of the neighbours; a line of
    another text counts between both neighbours.
    """
    if not comment.code.strip():
        return comment.line if 0 < comment.line <= len(lines) else 0
    above, below = list_above(lines), list_above(lines[::-1])[::-1]
    wanted = comment.above.strip(), comment.below.strip()
    beside = {
        number: sum(bool(now) and now == was for now, was in zip(pair, wanted, strict=True))
        for number, pair in enumerate(zip(above, below, strict=True), 1)
    }
    same = [n for n, text in enumerate(lines, 1) if text.strip() == comment.code.strip()]
    numbers = same or [n for n, count in beside.items() if count == 2 and lines[n - 1].strip()]
    most = max((beside[n] for n in numbers), default=0)
    if not most and len(same) != 1:
        return 0
    best = [n for n in numbers if beside[n] == most]
    return min(best, key=lambda n: abs(n - comment.line))


def list_above(lines: list[str]) -> list[str]:
    """Return for each line the nearest line before it that is not empty, without indentation."""
    return list(accumulate(lines[:-1], lambda last, line: line.strip() or last, initial=""))


def write_comment(student: str, words: str, file: str, line: int, content: bytes) -> Comment:
    """Return a comment on the present text of this line."""
    lines = read_lines(content)
    above, below = list_above(lines[:line])[-1], list_above(lines[line - 1 :][::-1])[-1]
    return Comment(student, words, file, line, lines[line - 1].strip(), above, below)


def describe_remark(remark: Remark) -> str:
    """Return a comment and its place on one line."""
    place = f"{remark.place}: " * bool(remark.place)
    note = f" ({remark.note})" if remark.note else ""
    return f"{place}{remark.comment}{note}"
