"""Ladders: answers to one TODO from nothing to complete; a better one must not earn less.

The rungs of a ladder are the tables of `tests/bank/ladders/TODO.toml`. Their names begin with 0, 1
and so on. A rung has the code of a `wrong` member, or its own `code` or `change` (see members.py).
One with none of these is the solution.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

from grader.bank.members import Member, Rung, read_tables
from grader.judge.result import Result


@dataclass
class Ladder:
    """The graded rungs of one sheet, lowest first."""

    sheet: Path
    points: dict[str, int] = field(default_factory=dict)  # by rung
    most: int = 0

    @property
    def name(self) -> str:
        return self.sheet.stem

    @property
    def complaint(self) -> str:
        """Return what is wrong with the points of its rungs."""
        bottom, *_, top = read_tables(self.sheet, Rung)
        if self.points.get(bottom, 0) > 0:
            return f"{bottom} earns {self.points[bottom]} points for nothing"
        for below, above in pairwise(self.points):
            if self.points[above] < self.points[below]:
                return f"{above} earns less than {below}"
        if self.points.get(top, self.most) < self.most:
            return f"{top} earns {self.points[top]} of {self.most} points"
        return ""


def list_ladders(graded: Iterable[tuple[Member, Result | None]]) -> list[Ladder]:
    """Return the ladders with graded rungs."""
    found: dict[Path, Ladder] = {}
    for member, result in graded:
        if member.is_rung and member.source and result is not None:
            ladder = found.setdefault(member.source, Ladder(member.source))
            rung = member.name.removeprefix(f"{ladder.name}-")
            ladder.points[rung] = sum(todo.points for todo in result.todos)
            ladder.most = sum(todo.max_points for todo in result.todos)
    for ladder in found.values():
        ladder.points = dict(sorted(ladder.points.items()))
    return list(found.values())
