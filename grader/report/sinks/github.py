"""Write annotations for GitHub Actions, and prevent other text from acting as a command."""

import base64
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from grader.judge.result import Result, TodoResult
from grader.judge.wording import add_task, format_reasons
from grader.report.sinks.reporter import write_reporter
from grader.text import clean

SHOWN = 10  # errors, and as many warnings, that GitHub shows of one step


def write_annotations(result: Result, inside: str = "") -> str:
    """Return a workflow command for each TODO with a failed check, at the student's line.

    A bonus task is a warning. `inside` is the submission's folder in the repository.
    """
    todos = [todo for todo in result.todos_to_show if todo.failed]
    lines = [
        write_annotation("error" if number < SHOWN and not todo.bonus else "warning", todo, inside)
        for number, todo in enumerate(todos)
    ]
    return "".join(f"{line}\n" for line in lines)


def write_annotation(kind: str, todo: TodoResult, inside: str) -> str:
    """Return the command for a TODO: its first failed check, and the number of others."""
    check, *others = todo.failed
    place = ""
    if check.where:
        file = "/".join(filter(None, (inside, clean(check.where.file))))
        place = f"file={escape_property(file)},line={check.where.line},"
    words = [check.title, *format_reasons(check)]
    if others:
        words.append(f"Checks of this TODO that failed as well: {len(others)}")
    title = escape_property(add_task(todo, todo.title))
    return f"::{kind} {place}title={title}::{escape_message(chr(10).join(words))}"


def escape_message(words: str) -> str:
    return words.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def escape_property(words: str) -> str:
    return escape_message(words).replace(":", "%3A").replace(",", "%2C")


def write_outputs(result: Result) -> str:
    encoded = base64.b64encode(write_reporter(result)).decode("ascii")
    return f"points={result.points}\nmax-points={result.max_points}\nresult={encoded}\n"


@contextmanager
def stop_commands(environment: Mapping[str, str]) -> Iterator[None]:
    """Stop GitHub Actions from reading commands in the text printed meanwhile."""
    if environment.get("GITHUB_ACTIONS") != "true":
        yield
        return
    token = os.urandom(16).hex()
    print(f"::stop-commands::{token}", flush=True)
    try:
        yield
    finally:
        print(f"::{token}::", flush=True)
