"""Find what a failed check means, and where to look: the first explanation that fits is used."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import msgspec

from grader.judge.explain.blame import GivenCause
from grader.judge.explain.diagnosis import Diagnosis
from grader.judge.explain.misconceptions import Mistake
from grader.judge.explain.one_change import Mend
from grader.judge.failures import ENDLESS, KEPT, MOST_NAMES, TRESPASS
from grader.judge.lab import Observation
from grader.judge.result import CheckResult, Where
from grader.judge.rubric import Todo
from grader.judge.submission import load_given
from grader.source.suspects import Suspect
from grader.text import join_words

OUTSIDE = "The reason is in none of the TODOs: look at the code around them."
MISSING = "There is no {program} here, in a file or a folder: hand it in with the others."
RESTORE = (
    "There is no {program}.py here. check --restore {program}.py puts the handed-out one back."
)
ROUNDED = (
    "Right to four digits and more, but not to all: is a number rounded, is float32 used for it, "
    "or does the formula only come close?"
)
PRINTED_ERROR = re.compile(r"\b(\w+(?:Error|Exception): [^|]*)$")
CALLED_BACK = {  # advice on an error of such a function, by a part of the error
    "takes ": "pymunk gives it three things: (arbiter, space, data).",
    "missing ": "pymunk gives it three things: (arbiter, space, data).",
    "NoneType": "Its data is None: hand data to on_collision as well, data=data.",
    "UnboundLocalError": "The variable that it assigns is local to it: count in data.",
}
UNFIT = (
    "ZeroDivisionError",
    "ValueError: Can't normalize",
)  # a case was reached that must not occur
LONGEST = 110  # letters of a quoted line
NEARLY, NOTHING = 5e-5, 1e-9  # relative error of a rounded number; absolute error of 0
NUMBER = re.compile(r"(?<![\w.^])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
FINISH = "TODO {ids} must be right before this can be checked: finish {it} first."


@dataclass(frozen=True)
class BadLine:
    """A line that should be gone from a TODO's region, and a sentence about it."""

    words: str
    where: Where
    is_all: bool  # whether it is the only reason to name
    answers: bool = False  # whether the function always returns at this line


@dataclass(frozen=True)
class Evidence:
    """Evidence on all failures of one TODO."""

    todo: Todo
    mistake: Mistake | None = None
    answers: Sequence[Observation] = ()  # answers to all its checks
    bad_line: BadLine | None = None
    suspects: Mapping[str, Suspect] = field(default_factory=dict)  # by kind; see find_suspects
    remark: str = ""  # the reason why no code of the TODO counts

    @cached_property
    def diagnosis(self) -> Diagnosis:
        return Diagnosis(self.todo.id, self.answers)

    def suspect(self, kind: str) -> str:
        """Return the words about a suspect line of this kind; empty if there is none."""
        return self.suspects[kind].words if kind in self.suspects else ""


@dataclass(frozen=True)
class Failure:
    """A failed check, with the evidence on it and on its TODO."""

    check: CheckResult
    evidence: Evidence
    answers: Sequence[Observation] = ()
    kept_names: Sequence[str] = ()  # names that held a value from call to call
    trespass: str = ""  # forbidden changes, in words
    given_cause: GivenCause | None = None
    earlier: Sequence[str] = ()  # TODOs in which the program fails first
    start: Where | None = None  # the file with the program's main
    hint: Callable[[], str] = lambda: ""  # words about names, arguments and errors
    mend: Mend | None = None

    @property
    def is_error(self) -> bool:
        return self.check.state == "error"


def explain(failure: Failure) -> CheckResult:
    """Return a failed check with its meaning and a line to look at."""
    check, evidence = failure.check, failure.evidence
    meaning = next(filter(None, (each(failure) for each in EXPLAINERS)), check.meaning)
    where = check.where or failure.start
    if failure.given_cause is not None:
        where = failure.given_cause.place(check)
    elif evidence.bad_line is not None and evidence.bad_line.is_all:
        where = evidence.bad_line.where
    elif where is not None and (line := find_line(failure, meaning)):
        where = Where(where.file, line)
    return msgspec.structs.replace(check, meaning=meaning, where=where)


def is_unexplained(failure: Failure) -> bool:
    """Return whether no reason for a wrong answer is known."""
    check = failure.check
    if failure.evidence.mistake is not None:
        return False
    if check.got.startswith(UNFIT):
        return True
    before = EXPLAINERS[: EXPLAINERS.index(point_to_line)]
    wrong = check.state == "not yet" and not check.meaning
    return wrong and not any(explainer(failure) for explainer in before)


def find_line(failure: Failure, meaning: str) -> int:
    """Return the line that our own words name; 0 if none does.

    Words of a submission are not searched: they may name any line.
    """
    if failure.mend is not None and failure.mend.in_words in meaning:
        return failure.mend.lines[0]
    suspects = failure.evidence.suspects.values()
    return next((each.line for each in suspects if each.words in meaning), 0)


# ---------------------------------------------------------------- the explanations


def blame_given_code(failure: Failure) -> str:
    """Name changed given code; if not the only cause, add the next explanation."""
    cause = failure.given_cause
    if cause is None:
        return ""
    if cause.is_gone:
        return f"{cause.in_words} {explain_names(failure)}".rstrip()
    more = "" if cause.is_all else explain_after(blame_given_code, failure)
    return f"{cause.in_words} {more}".rstrip()


def explain_after(explainer: "Explainer", failure: Failure) -> str:
    """Return the first explanation by the explainers after this one."""
    after = EXPLAINERS[EXPLAINERS.index(explainer) + 1 :]
    return next(filter(None, (each(failure) for each in after)), "")


def name_leftover(failure: Failure) -> str:
    """Name lines of the starter, or a line that ends the function before the student's code.

    If some of the student's code runs, explain that first.
    """
    line = failure.evidence.bad_line
    if line is None or (line.answers and failure.trespass):  # it returns what this code changed
        return ""
    if line.is_all or (line.answers and not failure.is_error):
        return line.words
    return f"{explain_after(name_leftover, failure)} {line.words}".strip()


def name_loop(failure: Failure) -> str:
    """Name the loop of a TODO whose check ran out of time."""
    out_of_time = failure.is_error and failure.check.got.startswith(ENDLESS)
    return failure.evidence.suspect("loop") if out_of_time else ""


def name_printed_error(failure: Failure) -> str:
    """Name the error of a function that pymunk calls: pymunk prints it and goes on."""
    printed = "" if failure.is_error else failure.check.printed or ""
    found = PRINTED_ERROR.search(printed)
    error = re.sub(r"\w+\.<locals>\.", "", found[1].strip()) if found else ""
    if not error:
        return ""
    advice = next((f". {words}" for part, words in CALLED_BACK.items() if part in error), "")
    return f"pymunk called a function of yours that raised an error: {error}{advice}"


def explain_names(failure: Failure) -> str:
    """Name a renamed function or argument, or explain an error whose cause is not known."""
    known = failure.evidence.mistake is not None or failure.mend is not None
    return "" if known and failure.check.got.startswith(UNFIT) else failure.hint()


def name_suspect(kind: str, is_all: bool = False) -> "Explainer":
    """Return an explainer that names a suspect line, alone if `is_all`, or after others."""

    def name(failure: Failure) -> str:
        words = "" if failure.is_error else failure.evidence.suspect(kind)
        if not words or is_all:
            return words
        return f"{explain_after(name, failure)} {words}".strip()

    return name


def name_kind(failure: Failure) -> str:
    """Name an answer of the wrong kind that no known mistake in other answers explains."""
    check = failure.check
    return check.meaning if check.meaning.endswith(f"; it is {check.got}.") else ""


def name_mistake(failure: Failure) -> str:
    """Name the only known mistake that predicts all answers of the TODO."""
    return failure.evidence.mistake.meaning if failure.evidence.mistake else ""


def name_earlier_todos(failure: Failure) -> str:
    """Name the TODOs in which the program fails before it reaches this one."""
    ids = failure.earlier
    return (
        FINISH.format(ids=join_words([*ids]), it="it" if len(ids) == 1 else "them") if ids else ""
    )


def name_trespass(failure: Failure) -> str:
    """Name a forbidden change, which may also explain a wrong answer."""
    rule = failure.evidence.suspect("alias") or TRESPASS.format(name="It")
    return f"{failure.trespass}. {rule}" if failure.trespass else ""


def name_rounding(failure: Failure) -> str:
    """Name rounding if each number is right to some digits, but not to all."""
    check = failure.check
    right, ours = (list(map(float, NUMBER.findall(each))) for each in (check.expected, check.got))
    right = right[: len(ours)]  # other numbers may come from the question
    if right == ours or len(right) < len(ours) or check.state != "not yet":
        return ""
    if failure.evidence.diagnosis.findings:  # a known mistake comes near as well
        return ""
    pairs = zip(right, ours, strict=True)
    near = all(math.isclose(a, b, rel_tol=NEARLY, abs_tol=NOTHING) for a, b in pairs)
    return ROUNDED if near else ""


def point_out_of_region(failure: Failure) -> str:
    """Name code of the TODO outside its region, and describe the answers."""
    words = failure.evidence.suspect("outside")
    return f"{words} {describe_answers(failure)}".strip() if words else ""


def point_to_line(failure: Failure) -> str:
    """Name the line in which one change mends the whole TODO, and describe the answers."""
    if failure.mend is None:
        return ""
    first = describe_answers(failure).partition(". ")[0].removesuffix(".")
    words = failure.mend.in_words
    return f"{words} {first}." if 0 < len(first) <= LONGEST else words


def describe_answers(failure: Failure) -> str:
    """Return the check's own words, or how its answers differ from the right ones.

    It also names values kept from call to call, which alone are no mistake.
    """
    words = failure.check.meaning or failure.evidence.diagnosis.describe(failure.answers)
    names = [name.rpartition(".")[2] for name in failure.kept_names[:MOST_NAMES]]
    return f"{words} {KEPT.format(names=', '.join(names))}".strip() if names else words


def name_rebound(failure: Failure) -> str:
    """Name an argument that gets another value, if no other reason is known."""
    return failure.evidence.suspect("rebound")


def repeat_remark(failure: Failure) -> str:
    """Repeat why there is no code, or name a missing program."""
    ran, remark = failure.check.ran, failure.evidence.remark
    program = ran.removeprefix("import ")
    if remark or failure.start is not None or program == ran:
        return remark
    return (RESTORE if f"{program}.py" in load_given() else MISSING).format(program=program)


def point_outside(failure: Failure) -> str:
    """Say that no TODO is the cause, for the whole program."""
    return "" if failure.evidence.todo.function else OUTSIDE


Explainer = Callable[[Failure], str]
EXPLAINERS: tuple[Explainer, ...] = (
    blame_given_code,
    name_leftover,
    name_loop,
    name_printed_error,
    explain_names,
    name_suspect("swapped sign", is_all=True),
    name_suspect("unread"),
    name_suspect("return in loop"),
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
