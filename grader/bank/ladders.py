"""Ladders: answers to one TODO from nothing to all, of which a better one never earns less.

The rungs of a ladder are `tests/bank/ladders/ID/0-name.py`, `1-name.py` and so on.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

from grader.bank.members import Member
from grader.judge.result import Result


@dataclass
class Ladder:
    """The rungs of one folder that were graded, lowest first."""

    folder: Path
    points: dict[str, int] = field(default_factory=dict)  # by rung
    most: int = 0

    @property
    def name(self) -> str:
        return self.folder.name

    @property
    def complaint(self) -> str:
        """What is wrong with the points of its rungs."""
        stems = sorted(path.stem for path in self.folder.glob("*.py"))
        bottom, top = stems[0], stems[-1]
        if self.points.get(bottom, 0) > 0:
            return f"{bottom} earns {self.points[bottom]} points for nothing"
        for below, above in pairwise(self.points):
            if self.points[above] < self.points[below]:
                return f"{above} earns less than {below}"
        if self.points.get(top, self.most) < self.most:
            return f"{top} earns {self.points[top]} of {self.most} points"
        return ""


def ladders(graded: Iterable[tuple[Member, Result | None]]) -> list[Ladder]:
    """The ladders of which rungs were graded."""
    found: dict[Path, Ladder] = {}
    for member, result in graded:
        if member.kind == "ladder" and member.is_patch and member.source and result is not None:
            ladder = found.setdefault(member.source.parent, Ladder(member.source.parent))
            ladder.points[member.source.stem] = sum(todo.points for todo in result.todos)
            ladder.most = sum(todo.max_points for todo in result.todos)
    for ladder in found.values():
        ladder.points = dict(sorted(ladder.points.items()))
    return list(found.values())
