"""Find out whether changed given code makes a check fail: run it with that code restored.

A check that passes then keeps its points, since the student's own code is right: changed given code
costs the program as a whole. Code that Python loads from elsewhere is not restored.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from grader.judge.failures import Broke, NotYet
from grader.judge.jobs import Key
from grader.judge.lab import Lab, Observation
from grader.judge.numbers import shorten_both, shorten_numbers
from grader.judge.result import CheckResult, Where
from grader.judge.submission import Submission, load_given
from grader.judge.wall.children import Child
from grader.source.given import GivenChange, compare_files, compare_whole_file, undo_changes
from grader.source.regions import read_source

MOST_ALONE = 8  # changes to undo one by one
EXPERIMENTS = {"ITERATIONS"}
MOST_RUNS = 60  # runs of checks with one change undone

OpenChild = Callable[[int], Child]


@dataclass(frozen=True)
class GivenCause:
    """The changes of given code that a failed check depends on."""

    changes: tuple[GivenChange, ...]
    mended: bool  # the check passes once they are undone

    @property
    def is_all(self) -> bool:
        """Return whether this is the only cause; missing code may be renamed, so it never is."""
        return self.mended and all(each.theirs for each in self.changes)

    @property
    def is_gone(self) -> bool:
        """Return whether code is missing without which its TODO cannot run."""
        return not self.mended and not any(each.theirs for each in self.changes)

    @property
    def is_experiment(self) -> bool:
        """Return whether only the number of solver passes differs, as the lesson suggests."""
        return all(each.name in EXPERIMENTS for each in self.changes)

    def place(self, check: CheckResult) -> Where:
        """Return the line of the first change; for missing code, the line where the check fails."""
        first = self.changes[0]
        place = check.where if check.where is not None and not first.theirs else first
        return Where(place.file, place.line, given=True)

    @property
    def in_words(self) -> str:
        if not self.mended and all(each.outside for each in self.changes):
            return " ".join(each.outside for each in self.changes)
        how = "; ".join(each.how for each in self.changes)
        undo = " ".join(f"--restore {each.to_type}" for each in self.changes)
        then = ", and this passes" if self.mended else ": do that first"
        return f"Given code was changed: {how}. check {undo} puts it back{then}."


def find_changes(
    submission: Submission, unusable: Iterable[Broke | NotYet] = ()
) -> list[GivenChange]:
    """Return the differences between a submission's given code and the handed-out code.

    `unusable` holds the imports that failed. Files with such an import are compared as a whole, as
    added code may be the reason.
    """
    folder, given = submission.folder, load_given()
    own = {n: read_source(folder / n) for n in given if (folder / n).is_file()}
    raised = [each.raised for each in unusable if isinstance(each, Broke) and each.raised]
    fails = {each.frames[-1].file for each in raised if each.frames} & own.keys()
    whole = [c for name in sorted(fails) for c in compare_whole_file(name, own[name], given[name])]
    others = {name: text for name, text in own.items() if name not in fails}
    return [*whole, *compare_files(others, given)]


def undo(submission: Submission, undone: Sequence[GivenChange]) -> dict[str, str]:
    """Return the changed files with these changes undone, as texts by name."""
    texts = {each.file: read_source(submission.folder / each.file) for each in undone}
    return {
        name: undo_changes(text, [each for each in undone if each.file == name])
        for name, text in texts.items()
    }


@dataclass
class CauseSearch:
    """Runs the failed checks of a submission again, with changes of given code undone."""

    changes: Sequence[GivenChange]
    open_with: Callable[[Sequence[GivenChange]], OpenChild]  # with these undone
    again: Callable[[Key, OpenChild], Lab]
    is_over: Callable[[], bool] = lambda: False  # the submission has used up its time
    runs: int = 0  # runs with one change undone
    causes: dict[Key, GivenCause] = field(default_factory=dict)
    answers: dict[Key, list[Observation]] = field(default_factory=dict)  # with all changes undone

    def look_into(self, failed: Mapping[Key, CheckResult]) -> None:
        """Run checks with all changes undone; where results differ, undo each change alone."""
        differ: dict[Key, bool] = {}
        open_child = self.open_with(self.changes)
        for key, check in failed.items():
            if self.is_over():
                break
            lab = self.again(key, open_child)
            if not isinstance(lab.failure, Broke):  # otherwise their own code needs the change
                self.answers[key] = lab.observations
            if makes_a_difference(lab, check):
                differ[key] = lab.failure is None
        alone = self._find_one(failed, differ) if differ else {}
        for key, mended in differ.items():
            self.causes[key] = GivenCause(tuple(alone.get(key, self.changes)), mended)

    def _find_one(
        self, failed: Mapping[Key, CheckResult], differ: Mapping[Key, bool]
    ) -> dict[Key, Sequence[GivenChange]]:
        """Return, by check, the single change that makes the difference, if one does.

        Of checks with the same error only the first runs; its change counts for all of them.
        """
        if not 1 < len(self.changes) <= MOST_ALONE:
            return {}
        found: dict[Key, Sequence[GivenChange]] = {}
        first = {key: find_first_like(failed, key) for key in differ}
        for change in self.changes:
            left = [key for key in differ if key not in found and first[key] == key]
            open_child = self.open_with([change])
            for key in left:
                if self.runs >= MOST_RUNS or self.is_over():
                    break
                self.runs += 1
                lab = self.again(key, open_child)
                if lab.failure is None or (
                    not differ[key] and makes_a_difference(lab, failed[key])
                ):
                    found[key] = [change]
        return {key: found[same] for key, same in first.items() if same in found}


def find_first_like(failed: Mapping[Key, CheckResult], key: Key) -> Key:
    """Return the first check with `key`'s error; `key` if it has none."""
    if failed[key].state != "error":
        return key
    return next(k for k, check in failed.items() if check.got == failed[key].got)


def makes_a_difference(lab: Lab, check: CheckResult) -> bool:
    """Return whether it passes now or, with no reference code, got another answer."""
    failure = lab.failure
    if failure is None:
        return True
    if lab.connection.pieces or lab.ended or not isinstance(failure, NotYet):
        return False
    got = shorten_both(failure.expected, failure.got)[1]
    return (shorten_numbers(failure.ran), got) != (check.ran, check.got)
