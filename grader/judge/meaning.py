"""Find what a failed check means, and where to look: the first explanation that fits is told."""

import math
import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import msgspec

from grader.judge.blame import Blamed
from grader.judge.diagnosis import Diagnosis
from grader.judge.failures import ENDLESS, KEPT, MOST_NAMES, REMEMBERS, TRESPASS
from grader.judge.lab import Observation
from grader.judge.mending import Mend
from grader.judge.misconceptions import Mistake
from grader.judge.result import CheckResult, Where
from grader.judge.rubric import Todo
from grader.judge.submission import load_given
from grader.text import listed

OUTSIDE = "No TODO is to blame for this: look at the code around them."
MISSING = "There is no {program} here, in a file or a folder: hand it in with the others."
RESTORE = (
    "There is no {program}.py here. check --restore {program}.py puts the handed-out one back."
)
ROUNDED = (
    "Right to four digits and more, but not to all: is a number rounded, or float32 used for it?"
)
PRINTED_ERROR = re.compile(r"\b(\w+(?:Error|Exception): [^|]*)$")
CALLED_BACK = {  # what to do about an error of such a function, by a part of the error
    "takes ": "pymunk gives it three things: (arbiter, space, data).",
    "missing ": "pymunk gives it three things: (arbiter, space, data).",
    "NoneType": "Its data is None: hand data to on_collision as well, data=data.",
    "UnboundLocalError": "What it assigns is its own alone: count in data.",
}
LINE = re.compile(r"\b[Ll]ine (\d+)")  # as the words about a region begin
UNFIT = ("ZeroDivisionError", "ValueError: Can't normalize")  # a case came where it must not
LONGEST = 110  # letters of what is said beside a line
NEARLY, NOTHING = 5e-5, 1e-9  # of a number, and what counts as none
NUMBER = re.compile(r"(?<![\w.^])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
FINISH = "TODO {ids} must be right before this can be checked: finish {it} first."


@dataclass(frozen=True)
class Left:
    """Say what was left in a TODO's region and should be gone, and in which line."""

    words: str
    where: Where
    is_all: bool  # whether nothing else needs to be told
    answers: bool = False  # whether it gives all answers that come at all


class RegionWords(NamedTuple):
    """Say what the text of a TODO shows, in words; empty where it shows no such thing."""

    outside: str = ""  # which line of its function stands outside its region
    rebound: str = ""  # which argument gets another value
    loop: str = ""  # which loop of its code may never end
    unread: str = ""  # which name gets a value that nothing reads
    swapped: str = ""  # which line has =+ for +=
    returns: str = ""  # which line returns in the first round of its loop
    alias: str = ""  # which line gives another's vector a second name, under which it is changed


NOTHING_SHOWN = RegionWords()


@dataclass(frozen=True)
class Evidence:
    """The evidence on the failures of one TODO; all mappings are by the ids of its checks."""

    todo: Todo
    mistake: Mistake | None = None
    answers: Mapping[str, list[Observation]] = field(default_factory=dict)
    kept: Mapping[str, list[str]] = field(default_factory=dict)  # names that held something
    trespasses: Mapping[str, str] = field(default_factory=dict)  # what was changed that must stay
    blamed: Mapping[str, Blamed] = field(default_factory=dict)
    earlier: Mapping[str, list[str]] = field(default_factory=dict)  # TODOs that it fails in first
    hint: Callable[[CheckResult], str] = lambda check: ""  # about names and arguments
    where: Mapping[str, Where] = field(default_factory=dict)  # where the program begins
    left: Left | None = None
    region: RegionWords = NOTHING_SHOWN
    remark: str = ""  # why no code of the TODO counts
    mends: Mapping[str, Mend] = field(default_factory=dict)  # the line in which a change mends it

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


def is_unexplained(evidence: Evidence, check: CheckResult) -> bool:
    """Return whether nothing names the reason of a wrong answer."""
    if evidence.mistake is not None:
        return False
    if check.got.startswith(UNFIT):
        return True
    before = EXPLAINERS[: EXPLAINERS.index(point_to_line)]
    wrong = check.state == "not yet" and not check.meaning
    return wrong and not any(explainer(evidence, check) for explainer in before)


def explain_check(evidence: Evidence, check: CheckResult) -> CheckResult:
    told = (explainer(evidence, check) for explainer in EXPLAINERS)
    meaning = next(filter(None, told), check.meaning)
    where = check.where or evidence.where.get(check.id)
    if check.id in evidence.blamed:
        where = evidence.blamed[check.id].place(check)
    elif evidence.left is not None and evidence.left.is_all:
        where = evidence.left.where
    elif where is not None and (line := find_told_line(evidence, check, meaning)):
        where = Where(where.file, line)
    return msgspec.structs.replace(check, meaning=meaning, where=where)


def find_told_line(evidence: Evidence, check: CheckResult, meaning: str) -> int:
    """Return the line that our own words name; 0 where none does.

    Never a line out of the words of a submission, which may name any.
    """
    mend = evidence.mends.get(check.id)
    if mend is not None and mend.in_words in meaning:
        return mend.lines[0]
    told = (words for words in evidence.region if words and words in meaning)
    return next((int(found[1]) for words in told if (found := LINE.search(words))), 0)


# ---------------------------------------------------------------- the explanations


def blame_given_code(evidence: Evidence, check: CheckResult) -> str:
    """Name the changed given code; where it is not the only reason, the next one follows."""
    blamed = evidence.blamed.get(check.id)
    if blamed is None:
        return ""
    if blamed.is_gone:
        return f"{blamed.in_words} {explain_names(evidence, check)}".rstrip()
    told = "" if blamed.is_all else explain_after(blame_given_code, evidence, check)
    return f"{blamed.in_words} {told}".rstrip()


def explain_after(explainer: "Explainer", evidence: Evidence, check: CheckResult) -> str:
    """Return what the first explainer behind this one says that says anything."""
    after = EXPLAINERS[EXPLAINERS.index(explainer) + 1 :]
    return next(filter(None, (each(evidence, check) for each in after)), "")


def name_what_was_left(evidence: Evidence, check: CheckResult) -> str:
    """Name lines that the starter had, or that end the function before the student's own.

    Where some of these run, what they do comes first.
    """
    if evidence.left is None:
        return ""
    if evidence.left.answers and evidence.trespasses.get(check.id):
        return ""  # the line returns what this code has changed
    if evidence.left.is_all or (evidence.left.answers and check.state != "error"):
        return evidence.left.words
    told = explain_after(name_what_was_left, evidence, check)
    return f"{told} {evidence.left.words}".strip()


def name_loop(evidence: Evidence, check: CheckResult) -> str:
    """Name the loop of a TODO whose check ran out of time: no answer was there to be explained."""
    return evidence.region.loop if check.state == "error" and check.got.startswith(ENDLESS) else ""


def name_printed_error(evidence: Evidence, check: CheckResult) -> str:
    """Name the error of a function that pymunk calls: pymunk prints it and goes on."""
    found = PRINTED_ERROR.search(check.printed or "") if check.state == "not yet" else None
    error = re.sub(r"\w+\.<locals>\.", "", found[1].strip()) if found else ""
    if not error:
        return ""
    told = next((f". {words}" for part, words in CALLED_BACK.items() if part in error), "")
    return f"pymunk called a function of yours that raised an error: {error}{told}"


def explain_names(evidence: Evidence, check: CheckResult) -> str:
    """Name a function or an argument that is called otherwise than it was handed out.

    Or say what an error means, unless it is known how the code came to it.
    """
    known = evidence.mistake is not None or check.id in evidence.mends
    return "" if known and check.got.startswith(UNFIT) else evidence.hint(check)


def name_swapped_sign(evidence: Evidence, check: CheckResult) -> str:
    """Name a line that gives a name a new value where it seems to add to the old one."""
    return evidence.region.swapped if check.state != "error" else ""


def name_unread(evidence: Evidence, check: CheckResult) -> str:
    """Name a value that nothing reads, which may be why the answers are wrong as they are."""
    if not evidence.region.unread or check.state == "error":
        return ""
    return f"{explain_after(name_unread, evidence, check)} {evidence.region.unread}".strip()


def name_return_in_loop(evidence: Evidence, check: CheckResult) -> str:
    """Name a return that no second round of its loop outlives, with what the answers are like."""
    if not evidence.region.returns or check.state == "error":
        return ""
    return (
        f"{explain_after(name_return_in_loop, evidence, check)} {evidence.region.returns}".strip()
    )


def name_kind(evidence: Evidence, check: CheckResult) -> str:
    """Say what kind of thing came instead: no known mistake of other answers explains that."""
    return check.meaning if check.meaning.endswith(f"; it is {check.got}.") else ""


def name_mistake(evidence: Evidence, check: CheckResult) -> str:
    """Name the one known mistake that gives all the answers of the TODO."""
    return evidence.mistake.meaning if evidence.mistake else ""


def name_trespass(evidence: Evidence, check: CheckResult) -> str:
    """Name a change of what must stay as it is, which may be why an answer is wrong as well."""
    found = evidence.trespasses.get(check.id)
    rule = evidence.region.alias or TRESPASS.format(name="It")
    return f"{found}. {rule}" if found else ""


def point_out_of_region(evidence: Evidence, check: CheckResult) -> str:
    """Name code of the TODO outside its region, with what its answers are like."""
    told = describe_answers(evidence, check) if evidence.region.outside else ""
    return f"{evidence.region.outside} {told}".strip()


def name_rounding(evidence: Evidence, check: CheckResult) -> str:
    """Name rounding, where each number is right to some digits and not to all."""
    right, ours = (list(map(float, NUMBER.findall(each))) for each in (check.expected, check.got))
    right = right[: len(ours)]  # what follows may be the question's
    if right == ours or len(right) < len(ours) or check.state != "not yet":
        return ""
    if evidence.diagnosis.findings:  # a known mistake comes near as well
        return ""
    pairs = zip(right, ours, strict=True)
    near = all(math.isclose(a, b, rel_tol=NEARLY, abs_tol=NOTHING) for a, b in pairs)
    return ROUNDED if near else ""


def point_to_line(evidence: Evidence, check: CheckResult) -> str:
    """Name the line in which one change mends all of the TODO, with what its answers are like."""
    if check.id not in evidence.mends:
        return ""
    said = describe_answers(evidence, check)
    first = said.partition(". ")[0].removesuffix(".")
    words = evidence.mends[check.id].in_words
    return f"{words} {first}." if 0 < len(first) <= LONGEST else words


def name_rebound(evidence: Evidence, check: CheckResult) -> str:
    """Name an argument that gets another value, where nothing else is known."""
    return evidence.region.rebound


def name_earlier_todos(evidence: Evidence, check: CheckResult) -> str:
    """Name the TODOs in which the program fails before it comes to this one."""
    ids = evidence.earlier.get(check.id, ())
    return FINISH.format(ids=listed([*ids]), it="it" if len(ids) == 1 else "them") if ids else ""


def describe_answers(evidence: Evidence, check: CheckResult) -> str:
    """Say what the check says itself, or how its answers differ from the right ones.

    That something is kept is no mistake alone. An answer that hangs on it looks like any other.
    """
    said = check.meaning or evidence.diagnosis.describe(evidence.answers.get(check.id, []))
    names = evidence.kept.get(check.id, [])[:MOST_NAMES]
    shown = ", ".join(name.rpartition(".")[2] for name in names)
    return f"{said} {KEPT.format(names=shown)}".strip() if names else said


def repeat_remark(evidence: Evidence, check: CheckResult) -> str:
    """Say why there is no code; a program that is missing has none."""
    program = check.ran.removeprefix("import ")
    if evidence.remark or check.id in evidence.where or program == check.ran:
        return evidence.remark
    return (RESTORE if f"{program}.py" in load_given() else MISSING).format(program=program)


def point_outside(evidence: Evidence, check: CheckResult) -> str:
    """Say of the program as a whole that the reason is in no TODO."""
    return "" if evidence.todo.function else OUTSIDE


Explainer = Callable[[Evidence, CheckResult], str]
EXPLAINERS: tuple[Explainer, ...] = (
    blame_given_code,
    name_what_was_left,
    name_loop,
    name_printed_error,
    explain_names,
    name_swapped_sign,
    name_unread,
    name_return_in_loop,
    name_kind,
    name_mistake,
    name_earlier_todos,
    name_trespass,
    name_rounding,
    point_out_of_region,
    point_to_line,
    describe_answers,
    name_rebound,
    repeat_remark,
    point_outside,
)
