"""Students half way: states of their work, and what the first failure must and must not say.

Each file of `tests/bank/halfway/` is about one TODO. It holds the code of a student who is right,
and states in which a part of it is missing, wrong, or wrong in two ways, or in which a name or a
given line was changed. What counts is the *Meaning* of the first failure, or its *Got* where there
is none: a student who is alone reads that.
"""

import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.bank.members import Edits, Replacement, indented, replace_text
from grader.judge.children import Worker
from grader.judge.grade import KIT, Options, grading
from grader.judge.result import CheckResult, Result
from grader.judge.rubric import load_rubric, visible
from grader.source.regions import read_source, regions_in, replaced

FOLDER = KIT / "tests" / "bank" / "halfway"
PROGRAMS = ("mini_engine", "lab_runtime.py", "integrators.py", "pymunk_scene.py")


class State(Struct, frozen=True, forbid_unknown_fields=True):
    """What a student has: the sheet's code with some text changed, or code of its own."""

    name: str
    says: list[str]  # regular expressions, each of which must be found
    never: list[str] = []  # and these must not
    change: list[tuple[str, str]] = []  # old and new text of the code; the old one stands once
    code: str = ""
    replace: list[Replacement] = []  # text outside the region


class Sheet(Struct, frozen=True, forbid_unknown_fields=True):
    file: str  # in which the TODO is
    code: str  # right, and as a student writes it
    state: list[State]


@dataclass(frozen=True)
class Halfway:
    """One state of one TODO."""

    todo: str
    file: str
    code: str  # of the region
    state: State

    @property
    def name(self) -> str:
        return f"{self.todo}-{self.state.name}"

    def build(self, folder: Path, tree: str = "solution") -> None:
        """Write it into `folder`, which must not exist; the other TODOs are those of the tree."""
        for program in PROGRAMS:
            source, target = KIT / tree / program, folder / program
            if source.is_dir():
                shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                folder.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source, target)
        path = folder / self.file
        text = read_source(path)
        region = next(region for region in regions_in(text) if region.id == self.todo)
        lines = indented(self.code.splitlines(), text, region)
        path.write_text(replaced(text, {self.todo: lines}), encoding="utf-8")
        replace_text(Edits(self.state.replace), folder)

    def complaint(self, result: Result) -> str:
        """What its first failure says that it must not, or fails to say; empty where it is well."""
        first = first_failure(result)
        if first is None:
            return "nothing fails"
        words = first.meaning or first.got
        missing = [each for each in self.state.says if not re.search(each, words, re.IGNORECASE)]
        wrong = [each for each in self.state.never if re.search(each, words, re.IGNORECASE)]
        if wrong:
            return f"says {', '.join(wrong)}: {words}"
        return f"does not say {', '.join(missing)}: {words}" if missing else ""


def halfway(todo: str = "") -> Iterator[Halfway]:
    """All states, or those of one TODO."""
    for path in sorted(FOLDER.glob(f"{todo or '*'}.toml")):
        sheet = msgspec.toml.decode(path.read_bytes(), type=Sheet)
        for state in sheet.state:
            yield Halfway(path.stem, sheet.file, code_of(sheet, state), state)


def code_of(sheet: Sheet, state: State) -> str:
    """The code of a state. Raises ValueError where an old text does not stand there once."""
    code = state.code or sheet.code
    for old, new in state.change:
        if code.count(old) != 1:
            raise ValueError(f"{state.name}: {old!r} stands there {code.count(old)} times")
        code = code.replace(old, new)
    return code


def first_failure(result: Result) -> CheckResult | None:
    return next((check for todo in result.todos for check in todo.failed), None)


def graded(state: Halfway, folder: Path, worker: Worker | None, tree: str = "solution") -> Result:
    """What students are told of it: no reference takes part, and no hidden check."""
    state.build(folder / state.name, tree)
    options = Options(reference=None, only=frozenset({state.todo}), trusted=True)
    with grading(folder / state.name, options, worker, visible(load_rubric())) as run:
        return run.run()
