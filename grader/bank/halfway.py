"""Half-way states of students' work, and what the first failure must and must not say.

Each file of `tests/bank/halfway/` is about one TODO. Its `code` is a right student's.
To add a state, add a table: `change` or `code` for the region, `files` for a given line or a name
that was changed (see members.py), and regular expressions:

    [state.upper-limit-only]
    change = [["if total < -limit:\\n    total = -limit", ""]]
    says = ["upper|one way"]

`place` puts the code where it does not count. `moved` renames the TODO's file with the work, and
puts the handed-out one in its place.

All in `says` must be found, none in `never` may be. They are searched in the *Meaning* of the first
failure, or in its *Got* without one. A wrong member with `says` is a state as well.
"""

import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent
from typing import Literal

import msgspec
from msgspec import Struct

from grader.bank.members import (
    BANK,
    Entry,
    Member,
    Regions,
    Wrong,
    indent_like,
    read_tables,
    solution_code,
)
from grader.judge.grade import grading
from grader.judge.result import CheckResult, Result
from grader.judge.rubric import drop_hidden, load_rubric
from grader.judge.submission import handed_out
from grader.judge.task import KIT, Options
from grader.judge.wall.children import Worker
from grader.source.regions import python_files, read_source, regions_in

# Position of the code: alone in its region, with the stub's lines above or below, or below a region
# that holds the stub.
Place = Literal["region", "below the stub", "above the stub", "outside"]


class State(Entry, frozen=True, kw_only=True):
    """A student's code: the sheet's code with some text changed, or its own code."""

    says: tuple[str, ...]  # regular expressions, each of which must be found
    never: tuple[str, ...] = ()  # and these must not
    place: Place = "region"
    moved: str = ""
    encoding: str = "utf-8"  # of the TODO's file


class Sheet(Struct, frozen=True, forbid_unknown_fields=True):
    code: str  # right, as a student writes it
    state: dict[str, State]


@dataclass(frozen=True)
class Halfway(Member):
    """One state of one TODO; the other TODOs are those of the solution."""

    entry: State

    @property
    def replaced_todos(self) -> frozenset[str]:
        return frozenset({self.name.partition("-")[0]})

    @property
    def judged_by(self) -> frozenset[str]:
        return self.replaced_todos

    @property
    def regions(self) -> Regions:
        (todo,) = self.replaced_todos
        code = self.entry.code.splitlines()
        stub = dedent(handed_out().stubs[todo]).splitlines()
        lines = {
            "region": code,
            "below the stub": [*stub, *code],
            "above the stub": [*code, *stub],
            "outside": stub,
        }
        return {todo: tuple(lines[self.entry.place])}

    def build(self, folder: Path) -> None:
        super().build(folder)
        (todo,) = self.replaced_todos
        start = f"# TODO {todo}: "
        file = next(path for path in python_files(folder) if start in read_source(path))
        if self.entry.place == "outside":
            put_below(self.entry.code, todo, file)
        if self.entry.moved:
            shutil.copyfile(file, folder / self.entry.moved)
            shutil.copyfile(KIT / "starter" / file.relative_to(folder), file)
        file.write_text(file.read_text(encoding="utf-8"), encoding=self.entry.encoding)

    def complaint(self, result: Result, seconds: float) -> str:
        """Return the fault in the words of its first failure, or an empty text."""
        first = find_failure(result)
        if first is None:
            return "nothing fails"
        words = first.meaning or f"{first.title}; expected {first.expected}; got {first.got}"
        missing = [each for each in self.entry.says if not re.search(each, words, re.IGNORECASE)]
        wrong = [each for each in self.entry.never if re.search(each, words, re.IGNORECASE)]
        if wrong:
            return f"says {', '.join(wrong)}: {words}"
        return f"does not say {', '.join(missing)}: {words}" if missing else ""

    def grade(self, folder: Path, worker: Worker | None) -> Result:
        """Grade it as students do: without the reference and without hidden checks."""
        options = Options(reference=None, only=self.judged_by, trusted=True)
        with grading(folder, options, worker, drop_hidden(load_rubric())) as run:
            return run.run()


def put_below(code: str, todo: str, file: Path) -> None:
    """Put code below the END marker of a TODO, indented like it."""
    text = read_source(file)
    region = next(each for each in regions_in(text) if each.id == todo)
    lines = text.splitlines()
    lines[region.stop + 1 : region.stop + 1] = indent_like(
        code.strip("\n").splitlines(), text, region
    )
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def list_states(todo: str = "") -> Iterator[Halfway]:
    """Yield all states, or those of one TODO; ValueError for edits that do not fit its code."""
    for path in sorted((BANK / "halfway").glob(f"{todo or '*'}.toml")):
        sheet = msgspec.toml.decode(path.read_bytes(), type=Sheet)
        for name, state in sheet.state.items():
            yield make_state(path.stem, name, sheet.code, state)
    for path in sorted((BANK / "wrong").glob(f"{todo or '*'}.toml")):
        for name, wrong in read_tables(path, Wrong).items():
            if wrong.says:
                words = State(
                    wrong.why, wrong.code, wrong.change, says=wrong.says, never=wrong.never
                )
                yield make_state(path.stem, wrong.state or name, solution_code()[path.stem], words)


def make_state(todo: str, name: str, right: str, state: State) -> Halfway:
    try:
        entry = msgspec.structs.replace(state, code=state.rewrite(right), change=[])
    except ValueError as error:
        raise ValueError(f"{todo}-{name}: {error}") from None
    return Halfway("halfway", f"{todo}-{name}", "package", entry, None)


def find_failure(result: Result) -> CheckResult | None:
    """Return the first check that fails, or passes only with given code restored."""
    checks = [check for todo in result.todos for check in todo.checks]
    return next((each for each in checks if each.failed or each.meaning), None)
