"""Word the result of one check, whether it passed, failed or could not run."""

import re
from typing import Any

from grader.judge.failures import Broke, NotYet
from grader.judge.jobs import Job
from grader.judge.numbers import shorten_both, shorten_numbers
from grader.judge.result import CheckResult, State, Where, in_bounds
from grader.judge.rubric import Todo
from grader.judge.submission import Submission, load_given
from grader.protocol import CodeLine, cut
from grader.source.flaws import Flaw

# An import of a name that the student's file does not define.
LACKING = re.compile(r"^ImportError: cannot import name .* from '[\w.]+' \((?P<file>[\w/]+\.py)\)")
INSTEAD = "The handed-out code replaced it, so that the rest could be checked."
MOST_UNREAD = 3  # maximum of named files that are too long
GIVEN_PRINTS = ("Fixed steps:", "Pendulum length", "Bodies:", "Box stack")  # endings of given code
MOST_PRINTED, MAX_PRINTED = 3, 60  # printed lines that are shown, and letters of each


def make_result(job: Job, state: State, **words: Any) -> CheckResult:
    most, kind = job.check.points, job.check.kind
    points = most if state == "passed" else 0
    return in_bounds(CheckResult(job.check.id, job.title, kind, state, points, most, **words))


def refuse(job: Job, flaw: Flaw) -> CheckResult:
    """Return the result of a check whose code Python does not accept."""
    part = f"this part of TODO {job.todo.id}" if job.todo.function else "this code"
    return make_result(
        job,
        "error",
        ran=f"reading {flaw.file}",
        expected="code that Python accepts",
        got=flaw.words,
        meaning=f"Python does not accept {part}, so none of it runs. {flaw.advice} {INSTEAD}",
        where=Where(flaw.file, flaw.line),
    )


def word_failure(submission: Submission, job: Job, failure: NotYet | Broke) -> CheckResult:
    """Return the result of a check that failed in this way."""
    where = submission.where.get(job.todo.id)
    unread = submission.unread[:MOST_UNREAD] if job.todo.function and where is None else []
    got = "; ".join([failure.got, *unread])
    if isinstance(failure, NotYet):
        expected, got = shorten_both(failure.expected, got)
        ran, meaning = shorten_numbers(failure.ran), failure.meaning
        words = {"ran": ran, "expected": expected, "got": got, "meaning": meaning}
        return make_result(job, "not yet", where=where, **words)
    frames = failure.raised.frames if failure.raised is not None else []
    if frames := [each for each in frames if submission.holds(each.file)]:
        last = frames[-1]
        own = [each for each in frames if not is_given(job.todo, each)]
        lacking = LACKING.search(failure.got)
        if lacking and submission.holds(lacking["file"]):
            where = Where(lacking["file"], 1)
        elif own or where is None:
            frame = (own or frames)[-1]
            where = Where(frame.file, frame.line)
        got += f" (in {last.file}, line {last.line}: {last.text})"
    return make_result(job, "error", where=where, ran=failure.ran, expected="an answer", got=got)


def is_given(todo: Todo, frame: CodeLine) -> bool:
    """Return whether a line is unchanged given code: then an error has its cause elsewhere."""
    text = load_given().get(frame.file)
    if text is None or frame.function == todo.function_name:
        return False
    return frame.text.strip() in map(str.strip, text.splitlines())


def last_lines(output: str) -> str:
    """Return the last printed lines, which came before the failure, as one line."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    lines = [cut(each, MAX_PRINTED) for each in lines if not each.startswith(GIVEN_PRINTS)]
    shown = " | ".join(lines[-MOST_PRINTED:])
    return f"… | {shown}" if len(lines) > MOST_PRINTED else shown
