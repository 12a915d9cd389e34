"""Find what a failed check means, and where to look: the first explanation that fits is told."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import msgspec

from grader.judge.blame import Blamed
from grader.judge.diagnosis import Diagnosis
from grader.judge.failures import KEPT, MOST_NAMES, REMEMBERS
from grader.judge.lab import Observation
from grader.judge.misconceptions import Mistake
from grader.judge.result import CheckResult, Where
from grader.judge.rubric import Todo

OUTSIDE = "No TODO is to blame for this: look at the code around them."
MISSING = "This program is not there: hand it in with the others."
FINISH = "TODO {ids} must be right before this can be checked: finish it first."


@dataclass(frozen=True)
class Evidence:
    """The evidence on the failures of one TODO; all mappings are by the ids of its checks."""

    todo: Todo
    mistake: Mistake | None = None
    answers: Mapping[str, list[Observation]] = field(default_factory=dict)
    kept: Mapping[str, list[str]] = field(default_factory=dict)  # names that held something
    blamed: Mapping[str, Blamed] = field(default_factory=dict)
    earlier: Mapping[str, list[str]] = field(default_factory=dict)  # TODOs that it fails in first
    hint: Callable[[CheckResult], str] = lambda check: ""  # about names and arguments
    where: Mapping[str, Where] = field(default_factory=dict)  # where the program begins

    @cached_property
    def diagnosis(self) -> Diagnosis:
        return Diagnosis(self.todo.id, [each for some in self.answers.values() for each in some])


def explain(
    evidence: Evidence, checks: list[CheckResult], failed: Collection[str]
) -> list[CheckResult]:
    """Return the checks, those that ran and failed with their meaning and a place to look at."""
    by_chance = any(check.meaning == REMEMBERS for check in checks)  # no number means anything
    known = replace(evidence, answers={}) if by_chance else evidence
    return [explain_check(known, c) if c.failed and c.id in failed else c for c in checks]


def explain_check(evidence: Evidence, check: CheckResult) -> CheckResult:
    told = (explainer(evidence, check) for explainer in EXPLAINERS)
    meaning = next(filter(None, told), check.meaning)
    where = check.where or evidence.where.get(check.id)
    if check.id in evidence.blamed:
        where = evidence.blamed[check.id].place(check)
    return msgspec.structs.replace(check, meaning=meaning, where=where)


# ---------------------------------------------------------------- the explanations


def blame_given_code(evidence: Evidence, check: CheckResult) -> str:
    """Name the changed given code; where it is not the only reason, the next one follows."""
    blamed = evidence.blamed.get(check.id)
    if blamed is None:
        return ""
    told = "" if blamed.is_all else next_explanation(evidence, check)
    return f"{blamed.in_words} {told}".rstrip()


def next_explanation(evidence: Evidence, check: CheckResult) -> str:
    return next(filter(None, (each(evidence, check) for each in EXPLAINERS[1:])), "")


def explain_names(evidence: Evidence, check: CheckResult) -> str:
    """Name a function or an argument that is called otherwise than it was handed out."""
    return evidence.hint(check)


def name_mistake(evidence: Evidence, check: CheckResult) -> str:
    """Name the one known mistake that gives all the answers of the TODO."""
    return evidence.mistake.meaning if evidence.mistake else ""


def name_earlier_todos(evidence: Evidence, check: CheckResult) -> str:
    """Name the TODOs in which the program fails before it comes to this one."""
    ids = ", ".join(evidence.earlier.get(check.id, ()))
    return FINISH.format(ids=ids) if ids else ""


def describe_answers(evidence: Evidence, check: CheckResult) -> str:
    """Say what the check says itself, or how its answers differ from the right ones.

    That something is kept is no mistake alone. An answer that hangs on it looks like any other.
    """
    said = check.meaning or evidence.diagnosis.describe(evidence.answers.get(check.id, []))
    names = evidence.kept.get(check.id, [])[:MOST_NAMES]
    shown = ", ".join(name.rpartition(".")[2] for name in names)
    return f"{said} {KEPT.format(names=shown)}".strip() if names else said


def point_outside(evidence: Evidence, check: CheckResult) -> str:
    """Say of the program as a whole that the reason is in no TODO."""
    if evidence.todo.function:
        return ""
    return OUTSIDE if check.id in evidence.where else MISSING


Explainer = Callable[[Evidence, CheckResult], str]
EXPLAINERS: tuple[Explainer, ...] = (
    blame_given_code,
    explain_names,
    name_mistake,
    name_earlier_todos,
    describe_answers,
    point_outside,
)
