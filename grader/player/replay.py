"""Make replays: run each failed check again, beside the right run.

Marks are already final. A replay that cannot be made is omitted.
"""

import importlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

from grader.judge.budget import Budget, for_words
from grader.judge.failures import Failing
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.rubric import CHECKS, Rubric
from grader.judge.wording import list_reasons
from grader.player.page import make_page
from grader.player.pairing import pair_runs
from grader.player.recording import OpenChild, Recorder, record_again
from grader.player.runs import Replay, Run
from grader.player.script import write_script

MAX_CHARACTERS, MAX_TOGETHER = 3_000_000, 20_000_000  # of a page and of all pages; usually 30,000
MAX_DEATHS = 3  # children that ended, after which no more runs of a submission are recorded
RECORDED = CHECKS / "expected_runs.json"

ExpectedRuns = dict[str, list[list[Run]]]  # by TODO and check: the runs of each scene


@dataclass
class Replays:
    """Writes a page and a script for each failed check of one submission."""

    folder: Path
    open_child: OpenChild
    open_reference: OpenChild | None
    budget: Budget = field(default_factory=Budget)
    deaths: int = 0
    written: int = 0  # characters

    def add_to(self, result: Result, failing: Mapping[tuple[str, str], Failing]) -> Result:
        """Write the replays; return the result with their paths."""
        if self.folder.is_symlink():
            return result  # it may lead anywhere
        todos = [
            msgspec.structs.replace(
                todo,
                checks=[self._add_to_check(todo, each, failing) for each in todo.checks],
            )
            for todo in result.todos
        ]
        return msgspec.structs.replace(result, todos=todos)

    def _add_to_check(
        self, todo: TodoResult, check: CheckResult, failing: Mapping[tuple[str, str], Failing]
    ) -> CheckResult:
        path = self.folder / f"{todo.id}-{check.id}.html"
        for old in (path, path.with_suffix(".py")):
            old.unlink(missing_ok=True)
        found = failing.get((todo.id, check.id))
        over = self.deaths >= MAX_DEATHS or not self.budget.has_more
        if found is None or not check.failed or over:
            return check
        try:
            made = self.make_files(todo, check, found)
        except Exception:  # a submission may cause any error; the marks stand
            made = None
        if made is None or self.written + sum(map(len, made)) > MAX_TOGETHER:
            return check
        self.written += sum(map(len, made))
        self.folder.mkdir(parents=True, exist_ok=True)
        for file, text in zip((path, path.with_suffix(".py")), made, strict=True):
            with open(file, "x", encoding="utf-8", newline="\n") as stream:
                stream.write(text)
        return msgspec.structs.replace(check, replay=f"{self.folder.name}/{path.name}")

    def make_files(
        self, todo: TodoResult, check: CheckResult, failing: Failing
    ) -> list[str] | None:
        """Return the page and the script, or None if there is nothing to show."""
        lab = record_again(failing, for_words(self.open_child), failing.pieces)
        self.budget.charge_for_words(lab.connection)
        self.deaths += lab.ended
        recorder = lab.recorder
        right = self._expected_scenes(failing, len(recorder.scenes))
        shown, both = self._choose_scenes(recorder, right)
        if not any(scene.lines for scene in both.scenes):
            return None
        steps = [step for steps in recorder.steps[shown] for step in steps]
        task = f"TODO {todo.id}, {todo.title}" if failing.todo.function else todo.title
        title = f"{task}: {check.title}"
        words = [f"Expected: {check.expected}", f"Got: {check.got}"]
        again = write_script(title, recorder.translator, steps, words)
        made = [make_page(title, list_reasons(check), both, again), again]
        return made if len(made[0]) <= MAX_CHARACTERS else None

    def _choose_scenes(self, recorder: Recorder, right: list[list[Run]]) -> tuple[slice, Replay]:
        """Return the scenes to show, and both runs of them.

        A check may go on after the scene in which it fails, so the last one may show nothing.
        """
        count = len(recorder.scenes)
        last = recorder.scenes_to_show()
        for shown in (last, *(slice(n, n + 1) for n in range(count)), slice(None), last):
            yours = [run for runs in recorder.scenes[shown] for run in runs]
            known = right[:count] if len(right) >= count else []
            expected = [run for runs in known[shown] for run in runs]
            both = pair_runs(yours, expected, exact=self.open_reference is not None)
            if both.parting:
                break
        return shown, both

    def _expected_scenes(self, failing: Failing, count: int) -> list[list[Run]]:
        """Return the right run's first scenes, from the reference or from a recording."""
        if self.open_reference is not None:
            return record_again(failing, self.open_reference, [], count).recorder.scenes
        return load_expected().get(f"{failing.todo.id}/{failing.check.id}", [])


@cache
def load_expected() -> ExpectedRuns:
    """Load the recorded right runs; only students' copies of the kit have them."""
    if not RECORDED.exists():
        return {}
    return msgspec.json.decode(RECORDED.read_bytes(), type=ExpectedRuns)


def record_expected(open_child: OpenChild, rubric: Rubric) -> bytes:
    """Record the right runs of all checks with fixed inputs, for a copy without a reference.

    `open_child` must open children of the reference.
    """
    runs: ExpectedRuns = {}
    for todo in rubric.todos:
        checks = importlib.import_module(f"grader.checks.{todo.folder}.checks")
        for check in todo.checks:
            if check.kind != "property" and not check.hidden:
                failing = Failing(todo, check, getattr(checks, check.id), [])
                scenes = record_again(failing, open_child, []).recorder.scenes
                for run in (run for runs in scenes for run in runs):
                    run.lines = [msgspec.structs.replace(x, code="") for x in run.lines]
                runs[f"{todo.id}/{check.id}"] = scenes
    return msgspec.json.encode(round_deeply(msgspec.to_builtins(runs)))


def round_deeply(value: Any) -> Any:
    """Round all numbers in lists and dicts to two decimals."""
    match value:
        case float():
            return round(value, 2)
        case list():
            return [round_deeply(each) for each in value]
        case dict():
            return {name: round_deeply(each) for name, each in value.items()}
    return value
