"""What changed given code has to do with a failed check: asked once more with it put back.

All marks are decided by then. Only failed checks are asked, and only where given code was changed.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import msgspec

from grader.judge.children import Child
from grader.judge.failures import NotYet
from grader.judge.lab import Lab, Observation
from grader.judge.numbers import readable, tidied
from grader.judge.result import CheckResult, Where
from grader.source.given import Changed

MOST_ALONE = 8  # changes that are each put back alone, to see which of them it is
MOST_ASKED = 60  # times that checks are asked again: a tree with many faults is told of soon, too

Key = tuple[str, str]  # the ids of a TODO and a check
OpenChild = Callable[[int], Child]


@dataclass(frozen=True)
class Blamed:
    """The changes of given code that a failed check hangs on."""

    changes: tuple[Changed, ...]
    mended: bool  # whether the check passes once they are undone

    def told(self, check: CheckResult) -> CheckResult:
        """The check with these changes for its reason, before whatever else it means."""
        first = self.changes[0]
        gone = not all(each.theirs for each in self.changes)  # then a new name may have been told
        alone = self.mended and not gone
        meaning = self.in_words if alone else f"{self.in_words} {check.meaning}".rstrip()
        place = check.where if check.where is not None and not first.theirs else first
        where = Where(place.file, place.line, given=True)
        return msgspec.structs.replace(check, meaning=meaning, where=where)

    @property
    def in_words(self) -> str:
        how = "; ".join(each.how for each in self.changes)
        undo = " ".join(f"--restore {each.to_type}" for each in self.changes)
        then = ", and this passes" if self.mended else ": do that first"
        return f"Given code was changed: {how}. check {undo} puts it back{then}."


@dataclass
class Blame:
    """Finds out which changes of given code the failed checks of a submission hang on."""

    changes: Sequence[Changed]
    open_with: Callable[[Sequence[Changed]], OpenChild]  # children of the tree with these undone
    again: Callable[[Key, OpenChild], Lab]
    spent: Callable[[], bool] = lambda: False  # whether the submission has used up its time
    asked: int = 0
    found: dict[Key, Blamed] = field(default_factory=dict)
    seen: dict[Key, list[Observation]] = field(default_factory=dict)  # with all of them undone

    def look_into(self, failed: Mapping[Key, CheckResult]) -> None:
        """Ask all, and then with each change undone alone those in which they make a difference."""
        differ: dict[Key, bool] = {}
        alike: dict[str, Key] = {}  # the first check with an error, for all that have it
        open_child = self.open_with(self.changes)
        for key, check in failed.items():
            first = alike.setdefault(check.got, key) if check.state == "error" else key
            if first is key and not self._is_enough():
                self._ask(key, check, open_child, differ)
        alone = dict.fromkeys(differ, self.changes[:1]) if len(self.changes) == 1 else {}
        if not alone and differ and len(self.changes) <= MOST_ALONE:
            alone = self._alone(failed, differ)
        for key, mended in differ.items():
            self.found[key] = Blamed(tuple(alone.get(key, self.changes)), mended)
        for key, check in failed.items():
            first = alike.get(check.got, key) if check.state == "error" else key
            if first in self.found:
                self.found[key] = self.found[first]

    def _ask(
        self, key: Key, check: CheckResult, open_child: OpenChild, differ: dict[Key, bool]
    ) -> None:
        lab = self._asked(key, open_child)
        self.seen[key] = lab.observations
        if makes_a_difference(lab, check):
            differ[key] = lab.failure is None

    def _asked(self, key: Key, open_child: OpenChild) -> Lab:
        self.asked += 1
        return self.again(key, open_child)

    def _is_enough(self) -> bool:
        return self.asked >= MOST_ASKED or self.spent()

    def _alone(
        self, failed: Mapping[Key, CheckResult], differ: Mapping[Key, bool]
    ) -> dict[Key, Sequence[Changed]]:
        """The one change that makes the difference to a check, as far as there is one."""
        found: dict[Key, Sequence[Changed]] = {}
        for change in self.changes:
            left = [key for key in differ if key not in found]
            open_child = self.open_with([change]) if left else None
            for key in left:
                assert open_child is not None
                if self._is_enough():
                    return found
                lab = self._asked(key, open_child)
                if lab.failure is None or (
                    not differ[key] and makes_a_difference(lab, failed[key])
                ):
                    found[key] = [change]
        return found


def makes_a_difference(lab: Lab, check: CheckResult) -> bool:
    """Whether a check passes now, or got something else; not where the reference took part."""
    failure = lab.failure
    if failure is None:
        return True
    if lab.connection.pieces or lab.ended or not isinstance(failure, NotYet):
        return False
    return (tidied(failure.ran), readable(failure.expected, failure.got)[1]) != (
        check.ran,
        check.got,
    )
