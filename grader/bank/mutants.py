"""Mutants: the solution with one small change, to see whether the checks notice.

A mutant is built like a wrong member of the bank: one region of the solution, put in. It is killed
if its own TODO loses points. No other TODO may lose any, and a mistake that is named must be the
one that was made.
"""

import difflib
import random
import re
import tempfile
import textwrap
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Literal

import msgspec
from msgspec import Struct
from rich.console import Console
from rich.table import Table

from grader.bank.members import Entry, Member
from grader.bank.slips import Scope, scopes, slipped
from grader.bank.verify import each_of, shared_worker
from grader.judge import misconceptions
from grader.judge.grade import KIT, Options, grading, shipped_reference
from grader.judge.lab import Observation
from grader.judge.misconceptions import Undecided
from grader.judge.result import CheckResult, Result
from grader.judge.rubric import Rubric, load_rubric
from grader.report.progress import Counter
from grader.source.definitions import function_named, statements
from grader.source.operators import changes, names_in, normal
from grader.source.regions import Region, python_files, read_source, regions_in

CPU_SECONDS = 2  # budget of a mutant's child: many never end, and the solution needs a quarter
OTHER_QUESTIONS = (7919, 104729)  # seeds of the questions that a name must stand up to
WRONGLY_NAMED = 0.02  # the largest share of mutants that may be

Verdict = Literal["killed", "survived", "equivalent"]
Naming = Literal["right", "none", "wrong"]
NAMINGS = ("named rightly", "not", "wrongly")  # heads of the table


# ---------------------------------------------------------------- making them


@dataclass(frozen=True)
class Mutant:
    """One changed region; `was` and `now` are the lines that differ."""

    todo: str
    number: int
    operator: str
    was: str
    now: str
    code: str

    @property
    def name(self) -> str:
        return f"{self.todo}-mutant-{self.number}"

    def patch(self) -> str:
        return f"# TODO {self.todo}: {self.operator}\n{self.code}\n# END TODO {self.todo}\n"

    def __str__(self) -> str:
        return f"TODO {self.todo}: {self.was or 'nothing'}  ->  {self.now or 'nothing'}"


@cache
def all_mutants() -> tuple[Mutant, ...]:
    """Every mutant of every TODO of the solution, in the order of the rubric."""
    solved, unfinished = regions_of("solution"), regions_of("starter")
    return tuple(
        mutant
        for todo in load_rubric().todos
        if todo.function
        for mutant in mutants_of(
            *solved[todo.id], todo.function.partition(":")[2], code_of(unfinished[todo.id][1])
        )
    )


def regions_of(tree: str) -> dict[str, tuple[str, Region]]:
    """The regions of the solution or the starter by TODO, each with the text it stands in."""
    return {
        region.id: (text, region)
        for path in python_files(KIT / tree)
        for text in [read_source(path)]
        for region in regions_in(text)
    }


def code_of(region: Region) -> str:
    return textwrap.dedent("\n".join(region.lines))


def mutants_of(text: str, region: Region, function: str, unfinished: str = "") -> Iterator[Mutant]:
    """The mutants of one region of a source text; `function` is the one it lives in.

    `unfinished` is what the starter has in its place.
    """
    found = function_named(statements(text), function)
    names = names_in(found) if found is not None else frozenset()
    parameters = frozenset(each.arg for each in found.args.args) if found is not None else names
    scope = msgspec.structs.replace(
        scopes().get(region.id, Scope()), parameters=parameters, unfinished=unfinished
    )
    code = code_of(region)
    made: dict[str, str] = {}
    for operator, change in (*changes(code, names), *slipped(code, scope)):
        made.setdefault(change, operator)
    for number, (change, operator) in enumerate(made.items(), 1):
        yield Mutant(region.id, number, operator, *difference(code, change), change)


def difference(code: str, change: str) -> tuple[str, str]:
    """The lines that differ, before and after; of an insertion, with the line below it."""
    before, after = lines_of(normal(code)), lines_of(change)
    was: list[str] = []
    now: list[str] = []
    for tag, i, j, k, m in difflib.SequenceMatcher(None, before, after, False).get_opcodes():
        if tag != "equal":
            more = 1 if tag == "insert" else 0
            was += before[i : j + more]
            now += after[k : m + more]
    if was == now:  # a line that was inserted in another place
        was, now = before, after
    return "; ".join(map(str.strip, was)), "; ".join(map(str.strip, now))


def lines_of(code: str) -> list[str]:
    """The lines of some code, broken where one pair of brackets follows another."""
    return re.split(r"\n|(?<=\)), (?=\()", code)


def sample(mutants: Sequence[Mutant], count: int, seed: int) -> list[Mutant]:
    """`count` of them, drawn from each TODO in turn; all of them if count is 0."""
    if not count:
        return list(mutants)
    rng = random.Random(seed)
    piles: dict[str, list[Mutant]] = {}
    for mutant in mutants:
        piles.setdefault(mutant.todo, []).append(mutant)
    for pile in piles.values():
        rng.shuffle(pile)
    chosen: list[Mutant] = []
    while len(chosen) < min(count, len(mutants)):
        chosen += [pile.pop() for pile in piles.values() if pile]
    return chosen[:count]


# ---------------------------------------------------------------- the ones that change nothing


class Equivalent(Struct, frozen=True, forbid_unknown_fields=True):
    """Mutants that give the same results, up to rounding, for everything the contract allows."""

    todo: str
    why: str
    changes: list[tuple[str, str]]  # the lines that differ, before and after


class Family(Struct, frozen=True, forbid_unknown_fields=True):
    """Mutants of some operators that change nothing for one reason."""

    todos: list[str]
    operators: list[str]
    why: str
    having: list[str] = []  # pieces, one of which is in the changed lines; none: whatever they are

    def has(self, mutant: Mutant) -> bool:
        known = mutant.todo in self.todos and mutant.operator in self.operators
        return known and any(piece in mutant.now for piece in self.having or [""])


class Equivalents(Struct, frozen=True, forbid_unknown_fields=True):
    equivalent: list[Equivalent]
    family: list[Family] = []


@cache
def listed() -> Equivalents:
    path = Path(__file__).with_name("equivalent.toml")
    return msgspec.toml.decode(path.read_bytes(), type=Equivalents)


@cache
def equivalents() -> dict[tuple[str, str, str], str]:
    """Why each of the mutants listed by itself changes nothing; by TODO and lines that differ."""
    return {(each.todo, *pair): each.why for each in listed().equivalent for pair in each.changes}


def is_equivalent(mutant: Mutant) -> bool:
    if (mutant.todo, mutant.was, mutant.now) in equivalents():
        return True
    return any(family.has(mutant) for family in listed().family)


# ---------------------------------------------------------------- grading one


@dataclass
class Outcome:
    """What came of one mutant."""

    mutant: Mutant
    lost: dict[str, int]  # points, by TODO
    mistake: str | None = None  # as it was named
    naming: Naming = "none"
    seconds: float = 0.0

    @property
    def verdict(self) -> Verdict:
        if self.mutant.todo in self.lost:
            return "killed"
        return "equivalent" if is_equivalent(self.mutant) else "survived"

    @property
    def complaint(self) -> str:
        """What is wrong with the grader, as this mutant shows; empty if nothing is."""
        others = sorted(set(self.lost) - {self.mutant.todo})
        if others:
            return f"TODO {', '.join(others)} must not lose anything"
        if self.lost and is_equivalent(self.mutant):
            return "is listed as equivalent, and lost points"
        return "survived" if self.verdict == "survived" else ""


class Noticed(KeyboardInterrupt):
    """A check failed, and the others need not run. pytest lets nothing else end a run."""


def grade_mutant(mutant: Mutant, alone: bool = False) -> Outcome:
    """Grade it on all TODOs of its program, and ask again where a mistake was named.

    `alone`, its own TODO is graded up to the first check that fails, and nothing is named: that
    shows survivors in a fraction of the time.
    """
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="mutant-") as folder:
        patch = Path(folder) / "patch.py"
        patch.write_text(mutant.patch(), encoding="utf-8")
        member = Member("wrong", mutant.name, "package", Entry(), patch)
        submission = Path(folder).resolve() / mutant.name
        member.build(KIT, submission)
        outcome = noticed(submission, mutant) if alone else graded(submission, mutant, member)
    outcome.seconds = time.monotonic() - start
    return outcome


def noticed(submission: Path, mutant: Mutant) -> Outcome:
    """Whether a check of its own TODO fails; what that one is worth is all that is counted."""
    lost: dict[str, int] = {}

    def stop_where_it_fails(check: CheckResult) -> None:
        if check.state not in ("passed", "waiting"):
            lost[mutant.todo] = check.max_points
            raise Noticed

    with suppress(Noticed):
        watched(submission, frozenset({mutant.todo}), progress=stop_where_it_fails)
    return Outcome(mutant, lost)


def graded(submission: Path, mutant: Mutant, member: Member) -> Outcome:
    result, _ = watched(submission, member.judged_by)
    lost = {t.id: t.max_points - t.points for t in result.todos if t.points != t.max_points}
    outcome = Outcome(mutant, lost)
    outcome.mistake = next((t.misconception for t in result.todos if t.misconception), None)
    if outcome.mistake is not None:
        holds = name_holds(submission, mutant.todo, outcome.mistake)
        outcome.naming = "right" if holds else "wrong"
    return outcome


def watched(
    path: Path,
    only: frozenset[str],
    seed: int | None = None,
    progress: Callable[[CheckResult], None] | None = None,
) -> tuple[Result, dict[str, list[Observation]]]:
    """The result for a submission, and every answer it gave, by TODO."""
    rubric = hurried(load_rubric())
    options = Options(shipped_reference(), only=only, seed=seed, progress=progress, trusted=True)
    with grading(path, options, shared_worker(), rubric) as run:
        return run.run(), run.observations


def hurried(rubric: Rubric) -> Rubric:
    """The same rubric with a smaller budget."""
    replace = msgspec.structs.replace
    return Rubric(
        [
            replace(todo, checks=[replace(each, cpu_seconds=CPU_SECONDS) for each in todo.checks])
            for todo in rubric.todos
        ]
    )


# ---------------------------------------------------------------- whether a name is right


def name_holds(submission: Path, todo: str, name: str) -> bool:
    """Whether the mistake's model gives the same numbers for questions that it was not named by."""
    return all(
        foretold(todo, name, watched(submission, frozenset({todo}), seed)[1].get(todo, []))
        for seed in OTHER_QUESTIONS
    )


def foretold(todo: str, name: str, seen: Sequence[Observation]) -> bool:
    """Whether a model of this mistake gives every answer it speaks of, and all others are right."""
    misconceptions.load_known(todo)
    models = [each for each in misconceptions.known if (each.todo, each.id) == (todo, name)]
    return any(
        misconceptions.explains(model, seen)
        and all(is_right(each) for each in seen if each.about != model.about)
        for model in models
    )


def is_right(seen: Observation) -> bool:
    try:
        return misconceptions.alike(misconceptions.right[seen.about](*seen.inputs), seen.answer)
    except Undecided:
        return True


# ---------------------------------------------------------------- all of them


@dataclass
class Campaign:
    outcomes: list[Outcome]

    @property
    def wrongly_named(self) -> list[Outcome]:
        return [each for each in self.outcomes if each.naming == "wrong"]

    @property
    def sound(self) -> bool:
        named_well = len(self.wrongly_named) <= WRONGLY_NAMED * len(self.outcomes)
        return named_well and not any(each.complaint for each in self.outcomes)


def chosen_from(
    mutants: Iterable[Mutant], todos: frozenset[str], operators: frozenset[str]
) -> list[Mutant]:
    """Those of these TODOs and operators; of all where none is named."""
    return [
        each
        for each in mutants
        if (not todos or each.todo in todos) and (not operators or each.operator in operators)
    ]


def campaign(
    mutants: Sequence[Mutant],
    count: int,
    seed: int,
    jobs: int,
    console: Console,
    alone: bool = False,
) -> Campaign:
    """Grade `count` of the mutants and print a table."""
    chosen = sample(mutants, count, seed)
    outcomes: list[Outcome] = []
    with Counter("grading mutants", len(chosen), console) as counter:
        for outcome in each_of(partial(grade_mutant, alone=alone), chosen, jobs):
            outcomes.append(outcome)
            counter.reached(len(outcomes))
            if outcome.complaint or outcome.naming == "wrong":
                console.print(describe(outcome))
    places = {mutant: place for place, mutant in enumerate(chosen)}
    outcomes.sort(key=lambda each: places[each.mutant])
    show(outcomes, console)
    return Campaign(outcomes)


def show(outcomes: Sequence[Outcome], console: Console) -> None:
    table = Table("TODO", "all", "killed", "survived", "equivalent", "score", *NAMINGS)
    for todo in dict.fromkeys(each.mutant.todo for each in outcomes):
        table.add_row(todo, *figures([each for each in outcomes if each.mutant.todo == todo]))
    table.add_section()
    table.add_row("all", *figures(outcomes))
    console.print(table)


def describe(outcome: Outcome) -> str:
    misled = f"is not {outcome.mistake}" if outcome.naming == "wrong" else ""
    words = "; ".join(filter(None, (outcome.complaint, misled)))
    return f"{outcome.mutant} ({outcome.mutant.operator}): {words}"


def figures(outcomes: Sequence[Outcome]) -> list[str]:
    """One row: how many, what became of them, and how the killed ones were named."""
    verdicts = [each.verdict for each in outcomes]
    killed, survived = verdicts.count("killed"), verdicts.count("survived")
    score = f"{100 * killed / (killed + survived):.0f}%" if killed + survived else "-"
    namings = [each.naming for each in outcomes if each.verdict == "killed"]
    named = [str(namings.count(each)) for each in ("right", "none", "wrong")]
    equivalent = verdicts.count("equivalent")
    return [*map(str, (len(outcomes), killed, survived, equivalent)), score, *named]
