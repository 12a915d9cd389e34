"""Replays: a failed check once more, before the camera, beside the run that should have been.

All marks are decided by then. A replay that cannot be made is left out and changes nothing else.
"""

import importlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

from grader.judge.budget import Budget, for_words
from grader.judge.children import Worker
from grader.judge.failures import Failing
from grader.judge.grade import Options, grading
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.rubric import CHECKS, Rubric, load_rubric
from grader.judge.wording import named_reasons
from grader.player.film import Take
from grader.player.filming import OpenChild, filmed
from grader.player.page import page
from grader.player.pairing import replay
from grader.player.script import renumber, script, step_of

MOST_CHARACTERS, MOST_TOGETHER = 3_000_000, 20_000_000  # of a page, and of all; usual are 30,000
MOST_DEATHS = 3  # of children, after which no more replays are made of a submission
RECORDED = CHECKS / "expected_runs.json"

Runs = dict[str, list[list[Take]]]  # by TODO and check: the takes of each scene


def grade_with_replays(
    path: Path | str, options: Options, folder: Path, worker: Worker | None = None
) -> Result:
    """Grade a submission, and write the replay of each failed check into `folder`."""
    with grading(Path(path), options, worker) as run:
        result = run.run()
        if not run.failing and not any(folder.glob("*.html")):
            return result
        open_right = run.open_right if options.reference else None
        known = frozenset(run.submission.functions)
        return Replays(folder, run.sandbox.open_child, open_right, known).of(result, run.failing)


@dataclass
class Replays:
    """Writes a page and a script for each failed check of one submission."""

    folder: Path
    open_child: OpenChild
    open_reference: OpenChild | None
    functions: frozenset[str] = frozenset()  # the TODOs whose functions the submission has
    budget: Budget = field(default_factory=Budget)
    deaths: int = 0
    written: int = 0  # characters

    def of(self, result: Result, failing: Mapping[tuple[str, str], Failing]) -> Result:
        """The result with the paths of its replays in it."""
        if self.folder.is_symlink():
            return result  # it may lead anywhere
        todos = [
            msgspec.structs.replace(
                todo,
                checks=[self._of_check(todo, each, failing) for each in todo.checks],
            )
            for todo in result.todos
        ]
        return msgspec.structs.replace(result, todos=todos)

    def _of_check(
        self, todo: TodoResult, check: CheckResult, failing: Mapping[tuple[str, str], Failing]
    ) -> CheckResult:
        path = self.folder / f"{todo.id}-{check.id}.html"
        for old in (path, path.with_suffix(".py")):
            old.unlink(missing_ok=True)
        found = failing.get((todo.id, check.id))
        over = self.deaths >= MOST_DEATHS or not self.budget.has_more
        if found is None or not check.failed or over:
            return check
        try:
            made = self._made(todo, check, found)
        except Exception:  # whatever a submission makes of it: the marks stand without a picture
            made = None
        if made is None or self.written + sum(map(len, made)) > MOST_TOGETHER:
            return check
        self.written += sum(map(len, made))
        self.folder.mkdir(parents=True, exist_ok=True)
        for file, text in zip((path, path.with_suffix(".py")), made, strict=True):
            with open(file, "x", encoding="utf-8", newline="\n") as stream:
                stream.write(text)
        return msgspec.structs.replace(check, replay=f"{self.folder.name}/{path.name}")

    def _made(self, todo: TodoResult, check: CheckResult, failing: Failing) -> list[str] | None:
        """The page and the script, or None where nothing is to be seen."""
        lab = filmed(failing, for_words(self.open_child), failing.pieces)
        self.budget.charge_for_words(lab.connection)
        self.deaths += lab.ended
        recorder = lab.recorder
        shown = recorder.shown(check.kind == "property")
        yours = [take for takes in recorder.scenes[shown] for take in takes]
        if not any(take.lines for take in yours):
            return None
        count = len(recorder.scenes)
        right = self._expected(failing)[:count]
        expected = [take for takes in right[shown] for take in takes] if len(right) == count else []
        steps = [step for steps in recorder.steps[shown] for step in steps]
        renumber(steps)
        both = replay(yours, expected, exact=self.open_reference is not None)
        parting = step_of(both, yours, steps)
        task = f"TODO {todo.id}, {todo.title}" if failing.todo.function else todo.title
        title = f"{task}: {check.title}"
        words = [f"Expected: {check.expected}", f"Got: {check.got}"]
        again = script(title, recorder.translator, steps, parting, words, self._paced(lab.module))
        made = [page(title, named_reasons(check), both, again), again]
        return made if len(made[0]) <= MOST_CHARACTERS else None

    def _paced(self, module: str) -> bool:
        """Whether the program has a function that runs the steps of a frame."""
        todos = [todo.id for todo in load_rubric().todos if todo.function == f"{module}:advance"]
        return any(todo in self.functions for todo in todos)

    def _expected(self, failing: Failing) -> list[list[Take]]:
        """The scenes of the right run: the reference's, or what was recorded of it."""
        if self.open_reference is not None:
            return filmed(failing, self.open_reference, []).recorder.scenes
        return recorded().get(f"{failing.todo.id}/{failing.check.id}", [])


# ---------------------------------------------------------------- runs recorded for students


@cache
def recorded() -> Runs:
    """The right runs that came with this copy of the checks; the kit itself has none."""
    if not RECORDED.exists():
        return {}
    return msgspec.json.decode(RECORDED.read_bytes(), type=Runs)


def record_expected(open_child: OpenChild, rubric: Rubric) -> bytes:
    """The right runs of all checks with fixed inputs, for a copy that comes without a reference.

    `open_child` opens children of the reference.
    """
    runs: Runs = {}
    for todo in rubric.todos:
        checks = importlib.import_module(f"grader.checks.{todo.folder}.checks")
        for check in todo.checks:
            if check.kind != "property" and not check.hidden:
                failing = Failing(todo, check, getattr(checks, check.id), [])
                scenes = filmed(failing, open_child, []).recorder.scenes
                for take in (take for takes in scenes for take in takes):
                    take.lines = [msgspec.structs.replace(x, code="") for x in take.lines]
                runs[f"{todo.id}/{check.id}"] = scenes
    return msgspec.json.encode(coarse(msgspec.to_builtins(runs)))


def coarse(value: Any) -> Any:
    """The same with two decimals."""
    match value:
        case float():
            return round(value, 2)
        case list():
            return [coarse(each) for each in value]
        case dict():
            return {name: coarse(each) for name, each in value.items()}
    return value
