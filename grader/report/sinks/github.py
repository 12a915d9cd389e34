"""GitHub Actions: annotations on the student's lines, and text that is no command to it."""

import base64
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from grader.judge.result import Result, TodoResult
from grader.judge.wording import named, reasons
from grader.report.sinks.reporter import reporter
from grader.text import clean

SHOWN = 10  # errors, and as many warnings: GitHub shows no more of one step


def annotations(result: Result, inside: str = "") -> str:
    """A workflow command for each TODO with a failed check, at the student's line.

    A bonus task is no error: nothing is missing without it.
    `inside` is the folder of the submission in the repository, empty for its root.
    """
    todos = [todo for todo in result.shown if todo.failed]
    lines = [
        annotation("error" if number < SHOWN and not todo.bonus else "warning", todo, inside)
        for number, todo in enumerate(todos)
    ]
    return "".join(f"{line}\n" for line in lines)


def annotation(kind: str, todo: TodoResult, inside: str) -> str:
    """The command for the first failed check of a TODO; the others are counted."""
    check, *others = todo.failed
    place = ""
    if check.where:
        file = "/".join(filter(None, (inside, clean(check.where.file))))
        place = f"file={in_property(file)},line={check.where.line},"
    words = [check.title, *reasons(check)]
    if others:
        words.append(f"Checks of this TODO that failed as well: {len(others)}")
    title = in_property(named(todo, todo.title))
    return f"::{kind} {place}title={title}::{in_message(chr(10).join(words))}"


def in_message(words: str) -> str:
    return words.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def in_property(words: str) -> str:
    return in_message(words).replace(":", "%3A").replace(",", "%2C")


def outputs(result: Result) -> str:
    """What later steps of the job may read, a line each."""
    encoded = base64.b64encode(reporter(result)).decode("ascii")
    return f"points={result.points}\nmax-points={result.max_points}\nresult={encoded}\n"


@contextmanager
def commands_stopped(environment: Mapping[str, str]) -> Iterator[None]:
    """What is printed meanwhile is text to GitHub Actions, whatever it looks like."""
    if environment.get("GITHUB_ACTIONS") != "true":
        yield
        return
    token = os.urandom(16).hex()
    print(f"::stop-commands::{token}", flush=True)
    try:
        yield
    finally:
        print(f"::{token}::", flush=True)
