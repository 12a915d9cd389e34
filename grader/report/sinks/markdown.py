"""Write Markdown as GitHub shows it: the summary of a job, the text of a release."""

import re
from itertools import accumulate

from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.wall.isolation import list_unconfined
from grader.judge.wording import (
    add_task,
    format_reasons,
    hidden_points_note,
    points_in_words,
    task_of,
)
from grader.text import clean

ROOM = 100_000  # characters: a release may have 125,000, a job's summary 1024 KiB


def write_markdown(result: Result) -> str:
    """Return a table of the TODOs and the reasons of failures.

    A submission's words are in fenced lines that begin with our own word, so none can end the
    fence.
    """
    elsewhere = hidden_points_note(result)
    lines = [
        f"## {escape_markdown(result.submission)}: {points_in_words(result)}",
        "",
        "| TODO | | state | points |",
        "|---|---|---|--:|",
        *map(write_row, result.todos_to_show),
        *(["", elsewhere] if elsewhere else []),
        *(f"\n{escape_markdown(note)}" for todo in result.todos_to_show for note in todo.notes),
        *limit([explain(todo, check) for todo in result.todos_to_show for check in todo.failed]),
        "",
        f"Isolation: {', '.join(result.isolation)}.",
    ]
    if lacking := list_unconfined(result.isolation):
        lines += ["", f"**Not confined here: {', '.join(lacking)}.**"]
    return "\n".join(lines) + "\n"


def write_row(todo: TodoResult) -> str:
    points = f"{todo.points} / {todo.max_points}" + " bonus" * todo.bonus
    return f"| {todo.id} | {escape_markdown(todo.title)} | {todo.state} | {points} |"


def explain(todo: TodoResult, check: CheckResult) -> str:
    """Return a heading and a fenced text, with empty lines around."""
    heading = f"#### {add_task(todo, escape_markdown(check.title))}"
    text = "\n".join(format_reasons(check, task_of(todo)))
    return f"\n{heading}\n\n```text\n{text}\n```"


def limit(parts: list[str]) -> list[str]:
    """Return the parts that fit, and the number of omitted ones."""
    ends = accumulate(map(len, parts))
    kept = [part for part, end in zip(parts, ends, strict=True) if end <= ROOM]
    left = len(parts) - len(kept)
    return [*kept, f"\nFurther failed checks: {left}."] if left else kept


def escape_markdown(words: str) -> str:
    return re.sub(r"[^\w ,()/'-]|_", lambda found: f"&#{ord(found[0])};", clean(words))
