"""Change the solution in one small way, and see whether the checks notice.

A mutant is built like a wrong member of the bank: one region of the solution is replaced. It is
killed if its own TODO loses points. No other TODO may lose any, and a named mistake must be the
real one.
"""

import difflib
import re
import tempfile
import textwrap
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any

import msgspec
from msgspec import Struct
from rich.console import Console
from rich.table import Table

from grader.bank.members import Entry, Member
from grader.bank.slips import SCOPES, Scope, make_slips
from grader.bank.verify import collect, run_in_processes, shared_worker
from grader.judge.explain import misconceptions
from grader.judge.explain.misconceptions import Undecided
from grader.judge.grade import grading
from grader.judge.lab import Observation
from grader.judge.passed import PASSED
from grader.judge.result import CheckResult, Result
from grader.judge.rubric import Rubric, load_rubric
from grader.judge.task import KIT, Options, shipped_reference
from grader.source.definitions import find_function, statements
from grader.source.operators import make_changes, names_in, normalize
from grader.source.regions import Region, python_files, read_source, regions_in

MUTANT_CPU_SECONDS = 2  # budget of a child: many never end, and the solution needs a quarter
OTHER_SEEDS = (7919, 104729)  # a named mistake must also fit the questions of these seeds

# ---------------------------------------------------------------- making them


@dataclass(frozen=True)
class Mutant:
    """One changed region; `was` and `now` are the lines that differ."""

    todo: str
    operator: str
    was: str
    now: str
    code: str

    def __str__(self) -> str:
        return f"TODO {self.todo}, {self.operator}: {self.was}  ->  {self.now}"


@cache
def mutants_of(todo: str) -> tuple[Mutant, ...]:
    """Make every mutant of one TODO of the solution, all with different code."""
    text, region = regions_of("solution")[todo]
    path = next(each.function or "" for each in load_rubric().todos if each.id == todo)
    function = find_function(statements(text), path.partition(":")[2])
    assert function is not None
    scope = msgspec.structs.replace(
        SCOPES.get(todo, Scope()),
        parameters=frozenset(each.arg for each in function.args.args),
        unfinished=code_of(regions_of("starter")[todo][1]),
    )
    code = code_of(region)
    operators = {normalize(code): ""}
    for operator, change in (*make_changes(code, names_in(function)), *make_slips(code, scope)):
        operators.setdefault(change, operator)
    return tuple(
        Mutant(todo, operator, *find_difference(code, change), change)
        for change, operator in operators.items()
        if operator
    )


@cache
def regions_of(tree: str) -> dict[str, tuple[str, Region]]:
    """Return the regions of the solution or the starter by TODO, each with its source text."""
    return {
        region.id: (text, region)
        for path in python_files(KIT / tree)
        for text in [read_source(path)]
        for region in regions_in(text)
    }


def code_of(region: Region) -> str:
    return textwrap.dedent("\n".join(region.lines))


def find_difference(code: str, change: str) -> tuple[str, str]:
    """Return the lines that differ, before and after; an insertion includes the line below it."""
    before, after = split_lines(normalize(code)), split_lines(change)
    was: list[str] = []
    now: list[str] = []
    for tag, i, j, k, m in difflib.SequenceMatcher(None, before, after, False).get_opcodes():
        if tag != "equal":
            more = 1 if tag == "insert" else 0
            was += before[i : j + more]
            now += after[k : m + more]
    return "; ".join(map(str.strip, was)), "; ".join(map(str.strip, now))


def split_lines(code: str) -> list[str]:
    """Split code into lines, also between two pairs of brackets."""
    return re.split(r"\n|(?<=\)), (?=\()", code)


def list_mutants(todos: Collection[str] = ()) -> list[Mutant]:
    """List the mutants of these TODOs, or of all if none is named."""
    named = [todo.id for todo in load_rubric().todos if todo.function]
    return [each for id in named if not todos or id in todos for each in mutants_of(id)]


# ---------------------------------------------------------------- equivalent mutants


class Equivalent(Struct, frozen=True, forbid_unknown_fields=True):
    """Mutants with the solution's results, up to rounding, for all inputs that the contract allows.

    They are listed one by one, by the lines that differ, or by operators and a piece of `now`.
    """

    todos: list[str]
    why: str
    changes: list[tuple[str, str]] = []  # the lines that differ, before and after
    operators: list[str] = []
    having: tuple[str, ...] = ("",)  # one of these pieces is in the lines after

    def has(self, mutant: Mutant) -> bool:
        if mutant.todo not in self.todos:
            return False
        if (mutant.was, mutant.now) in self.changes:
            return True
        return mutant.operator in self.operators and any(map(mutant.now.__contains__, self.having))


@cache
def load_equivalents() -> list[Equivalent]:
    text = Path(__file__).with_name("equivalent.toml").read_bytes()
    return msgspec.toml.decode(text, type=dict[str, list[Equivalent]])["equivalent"]


def is_equivalent(mutant: Mutant) -> bool:
    return any(each.has(mutant) for each in load_equivalents())


# ---------------------------------------------------------------- grading them


@dataclass
class Outcome:
    """The points that one mutant lost, and the mistake that was named."""

    mutant: Mutant
    lost: dict[str, int]  # by TODO
    mistake: str | None = None
    is_misnamed: bool = False

    @property
    def name(self) -> str:
        return str(self.mutant)

    @property
    def verdict(self) -> str:
        if self.mutant.todo in self.lost:
            return "killed"
        return "equivalent" if is_equivalent(self.mutant) else "survived"

    @property
    def complaint(self) -> str:
        """Return the fault in the grader that this mutant shows, or an empty text."""
        others = sorted(set(self.lost) - {self.mutant.todo})
        if others:
            return f"TODO {', '.join(others)} must not lose anything"
        if self.lost and is_equivalent(self.mutant):
            return "is listed as equivalent, and lost points"
        if self.verdict == "survived":
            return "survived"
        return f"is not {self.mistake}" if self.is_misnamed else ""


def grade_mutant(mutant: Mutant, alone: bool = False) -> Outcome:
    """Grade it on all TODOs of its program, and test the name of its mistake.

    With `alone`, grade only its own TODO up to the first check that fails, and test no name: that
    finds survivors much faster.
    """
    with tempfile.TemporaryDirectory(prefix="mutant-") as folder:
        submission = Path(folder).resolve() / "mutant"
        member = Member("wrong", f"{mutant.todo}-mutant", "package", Entry(code=mutant.code), None)
        member.build(submission)
        if alone:
            return Outcome(mutant, find_first_failure(submission, mutant.todo))
        result, _ = grade_quickly(submission, member.judged_by, passed=PASSED)
        lost = {t.id: t.max_points - t.points for t in result.todos if t.points != t.max_points}
        mistake = next((t.misconception for t in result.todos if t.misconception), None)
        misnamed = mistake is not None and not name_holds(submission, mutant.todo, mistake)
        return Outcome(mutant, lost, mistake, misnamed)


class CheckFailed(Exception):
    """Raised to end a run at the first check that fails."""


def find_first_failure(submission: Path, todo: str) -> dict[str, int]:
    """Grade one TODO until a check fails; return the points of that check."""

    def stop_where_it_fails(check: CheckResult) -> None:
        if check.state not in ("passed", "waiting"):
            raise CheckFailed(check.max_points)

    try:
        grade_quickly(submission, frozenset({todo}), progress=stop_where_it_fails)
    except CheckFailed as failure:
        return {todo: failure.args[0]}
    return {}


def grade_quickly(
    path: Path, only: frozenset[str], **options: Any
) -> tuple[Result, dict[str, list[Observation]]]:
    """Return the result and all answers by TODO, with a small budget for each check."""
    asked = Options(shipped_reference(), only=only, trusted=True, **options)
    with grading(path, asked, shared_worker(), load_quick_rubric()) as run:
        return run.run(), run.observations


@cache
def load_quick_rubric() -> Rubric:
    replace, todos = msgspec.structs.replace, load_rubric().todos
    quick = [
        [replace(each, cpu_seconds=MUTANT_CPU_SECONDS) for each in todo.checks] for todo in todos
    ]
    return Rubric([replace(todo, checks=checks) for todo, checks in zip(todos, quick, strict=True)])


# ---------------------------------------------------------------- testing a name


def name_holds(submission: Path, todo: str, name: str) -> bool:
    """Return whether the named mistake's model also predicts answers to other questions."""
    answers = (grade_quickly(submission, frozenset({todo}), seed=seed)[1] for seed in OTHER_SEEDS)
    return all(foretells_answers(todo, name, each.get(todo, [])) for each in answers)


def foretells_answers(todo: str, name: str, answers: Sequence[Observation]) -> bool:
    """Return whether a model predicts every answer that it covers, and all others are right."""
    misconceptions.load_known(todo)
    known = misconceptions.known_mistakes
    models = [each for each in known if (each.todo, each.id) == (todo, name)]
    return any(
        misconceptions.explains(model, answers)
        and all(is_right(each) for each in answers if each.about != model.about)
        for model in models
    )


def is_right(answer: Observation) -> bool:
    try:
        right = misconceptions.kinds[answer.about].right(*answer.inputs)
    except Undecided:
        return True
    return misconceptions.are_close(right, answer.answer)


# ---------------------------------------------------------------- all of them


def run_mutants(
    mutants: Sequence[Mutant], jobs: int, console: Console, alone: bool = False
) -> list[Outcome]:
    """Grade the mutants; print each complaint, and a table."""
    graded = run_in_processes(partial(grade_mutant, alone=alone), mutants, jobs)
    outcomes = collect("grading mutants", graded, len(mutants), console)
    table = Table("TODO", "all", "killed", "survived", "equivalent", "named")
    for todo in dict.fromkeys(each.todo for each in mutants):
        table.add_row(
            todo, *count_verdicts([each for each in outcomes if each.mutant.todo == todo])
        )
    table.add_section()
    table.add_row("all", *count_verdicts(outcomes))
    console.print(table)
    return outcomes


def count_verdicts(outcomes: Sequence[Outcome]) -> list[str]:
    verdicts = [each.verdict for each in outcomes]
    counts = [verdicts.count(each) for each in ("killed", "survived", "equivalent")]
    return [*map(str, (len(outcomes), *counts, sum(bool(each.mistake) for each in outcomes)))]
