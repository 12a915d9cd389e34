"""Read gradebook files, each by the columns that its learning system documents for import."""

import csv
import io
import re
from collections.abc import Callable
from typing import NamedTuple


class Cells(NamedTuple):
    """What a gradebook has about one student."""

    mark: str
    feedback: str = ""


Marks = dict[str, Cells]  # by a student's identifier


def rows_of(content: bytes, delimiter: str = ",") -> list[dict[str, str]]:
    utf_16 = content.startswith((b"\xff\xfe", b"\xfe\xff"))
    text = content.decode("utf-16" if utf_16 else "utf-8-sig")
    rows = list(csv.DictReader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True))
    assert all(None not in row and None not in row.values() for row in rows)
    return rows


def canvas(content: bytes, title: str) -> Marks:
    """`Student, ID, SIS User ID, SIS Login ID, Section`, then a column for each assignment."""
    rows = rows_of(content)
    first = list(rows[0])
    assert first[:2] == ["Student", "ID"] and "Section" in first
    (column,) = [name for name in first if re.fullmatch(rf"{re.escape(title)} \(\d+\)", name)]
    assert rows[0]["Student"].strip() == "Points Possible" and float(rows[0][column])
    return {row["ID"]: Cells(row[column]) for row in rows[1:]}


def moodle(content: bytes, title: str) -> Marks:
    """Read the worksheet: each row by its Identifier, with a Grade and Feedback comments."""
    rows = rows_of(content)
    assert all(re.fullmatch(r"Participant \d+", row["Identifier"]) for row in rows)
    for row in rows:
        assert row["Grade"] == "" or 0 <= float(row["Grade"]) <= float(row["Maximum Grade"])
    return {row["Identifier"]: Cells(row["Grade"], row["Feedback comments"]) for row in rows}


def blackboard(content: bytes, title: str) -> Marks:
    """By Username, tabs or commas between; the id of the column stands behind a bar."""
    rows = rows_of(content, "\t")
    wanted = rf"{re.escape(title)} \[Total Pts: \d+ Score\] \|\d+"
    (column,) = [name for name in rows[0] if re.fullmatch(wanted, name)]
    assert list(rows[0])[:3] == ["Last Name", "First Name", "Username"]
    return {row["Username"]: Cells(row[column]) for row in rows}


def brightspace(content: bytes, title: str) -> Marks:
    """By OrgDefinedId or Username; the last column holds a # in every row."""
    rows = rows_of(content)
    assert list(rows[0])[-1] == "End-of-Line Indicator"
    assert all(row["End-of-Line Indicator"] == "#" for row in rows)
    assert {"OrgDefinedId", "Username"} & set(rows[0])
    return {row["Username"]: Cells(row[f"{title} Points Grade"]) for row in rows}


def plain(content: bytes, title: str) -> Marks:
    """In the order of the class list, with a Grade and Feedback."""
    rows = rows_of(content)
    return {str(number): Cells(row["Grade"], row["Feedback"]) for number, row in enumerate(rows)}


READERS: dict[str, Callable[[bytes, str], Marks]] = {  # other systems take plain columns
    each.__name__: each for each in (canvas, moodle, blackboard, brightspace)
}
