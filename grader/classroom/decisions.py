"""Change the file of decisions table by table, and keep a person's notes between them.

Before writing, the new text is parsed: only the intended change may differ.
"""

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec

from grader.classroom.adjustments import read_adjustments
from grader.errors import Stop
from grader.judge.course import Course
from grader.report.files import write_whole

HEADER = re.compile(r"^[ \t]*\[\[?[ \t]*([\w-]+)[ \t]*\]\]?[ \t]*(#.*)?$")
HEAD = (
    "# What people decide about this class. `grader class review` writes it, and you may edit it.\n"
)
ODD_FORM = "a form that only people can change: edit it by hand"
Table = dict[str, Any]
NO_TABLES: Table = {"adjust": [], "comment": []}  # the kinds of decisions


@dataclass(frozen=True)
class Decision:
    """A table of the file: `adjust` or `comment`, its values, and its lines."""

    kind: str
    values: Table
    first: int = 0
    end: int = 0

    @property
    def key(self) -> str:
        """Return the name of this decision in a form."""
        return f"{self.kind} {sorted(self.values.items())!r}"

    @property
    def what(self) -> str:
        """Return the field that decides, such as `points`, `take` or `comment`."""
        return next((n for n in self.values if n not in ("student", "reason")), self.kind)

    @property
    def students(self) -> list[str]:
        who = self.values.get("student", [])
        return [who] if isinstance(who, str) else who


@dataclass(frozen=True)
class DecisionsFile:
    """The file of decisions of a class; it may not exist yet."""

    path: Path
    course: Course

    @property
    def text(self) -> str:
        return self.path.read_text(encoding="utf-8-sig") if self.path.is_file() else HEAD

    def list_decisions(self) -> list[Decision]:
        return find_decisions(self.text, self.path)

    def put(self, kind: str, values: Table, old: Decision | None = None) -> None:
        """Write a decision in the position of an old one, or else at the end of the file."""
        found, table = self.list_decisions(), write_table(kind, values)
        if old is None:
            self.write(f"{self.text.rstrip()}\n\n{table}", [*found, Decision(kind, values)])
        else:
            found[found.index(old)] = Decision(kind, values)
            self.write(replace_lines(self.text, old, table), found)

    def remove(self, key: str) -> None:
        """Remove a decision with its own lines; raises Stop if the file has changed."""
        found = self.list_decisions()
        old = next((each for each in found if each.key == key), None)
        if old is None:
            raise Stop(f"{self.path} has changed meanwhile: look at it again")
        found.remove(old)
        self.write(replace_lines(self.text, old, ""), found)

    def write(self, text: str, wanted: list[Decision]) -> None:
        """Write `text`; raises Stop unless it is valid and has the `wanted` decisions."""
        tables = {kind: [e.values for e in wanted if e.kind == kind] for kind in NO_TABLES}
        if read_tables(text, self.path) != read_tables(self.text, self.path) | tables:
            raise Stop(f"{self.path} has {ODD_FORM}")
        read_adjustments(text, self.path, self.course)
        write_whole(text.encode("utf-8"), self.path)


def replace_lines(text: str, old: Decision, table: str) -> str:
    lines = text.splitlines(keepends=True)
    return "".join([*lines[: old.first], table, *lines[old.end :]])


def read_tables(text: str, path: Path) -> Table:
    try:
        return NO_TABLES | tomllib.loads(text)
    except ValueError as error:
        raise Stop(f"{path}: {error}") from error


def find_decisions(text: str, path: Path) -> list[Decision]:
    """Return the decisions in the order of the file; raises Stop if their lines are not found.

    A table ends with its last value; notes and empty lines after it belong to the next table.
    """
    document = read_tables(text, path)
    left = {kind: iter(document[kind]) for kind in NO_TABLES}
    lines = text.splitlines(keepends=True)
    heads = [(n, head[1]) for n, line in enumerate(lines) if (head := HEADER.match(line))]
    ends = [*(first for first, _ in heads[1:]), len(lines)]
    found = []
    for (first, kind), end in zip(heads, ends, strict=False):
        if kind in left:
            while not lines[end - 1].partition("#")[0].strip():
                end -= 1
            found.append(Decision(kind, next(left[kind], {}), first, end))
    if len(found) != sum(len(document[kind]) for kind in left):
        raise Stop(f"{path} has {ODD_FORM}")
    return found


def write_table(kind: str, values: Table) -> str:
    """Write a table of texts, numbers and lists of texts, which have the same form in JSON."""
    lines = [f"{name} = {msgspec.json.encode(value).decode()}\n" for name, value in values.items()]
    return "".join([f"[[{kind}]]\n", *lines]).replace("\x7f", "\\u007f")
