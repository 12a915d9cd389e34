"""Markdown as GitHub shows it: the summary of a job, the text of a release."""

import re
from itertools import accumulate

from grader.judge.isolation import unconfined
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.wording import hidden_points_note, named, points_in_words, reasons, task_of
from grader.text import clean

ROOM = 100_000  # characters: a release may have 125,000, a job's summary 1024 KiB


def markdown(result: Result) -> str:
    """A table of the TODOs, then why checks failed.

    A submission's words stand in fenced lines that begin with a word of ours, so that none of them
    can end the fence.
    """
    elsewhere = hidden_points_note(result)
    lines = [
        f"## {literal(result.submission)}: {points_in_words(result)}",
        "",
        "| TODO | | state | points |",
        "|---|---|---|--:|",
        *map(row, result.shown),
        *(["", elsewhere] if elsewhere else []),
        *bounded([why(todo, check) for todo in result.shown for check in todo.failed]),
        "",
        f"Isolation: {', '.join(result.isolation)}.",
    ]
    if lacking := unconfined(result.isolation):
        lines += ["", f"**Not confined here: {', '.join(lacking)}.**"]
    return "\n".join(lines) + "\n"


def row(todo: TodoResult) -> str:
    points = f"{todo.points} / {todo.max_points}" + " bonus" * todo.bonus
    return f"| {todo.id} | {literal(todo.title)} | {todo.state} | {points} |"


def why(todo: TodoResult, check: CheckResult) -> str:
    """A heading and a fenced text, set apart by empty lines."""
    heading = f"#### {named(todo, literal(check.title))}"
    text = "\n".join(reasons(check, task_of(todo)))
    return f"\n{heading}\n\n```text\n{text}\n```"


def bounded(parts: list[str]) -> list[str]:
    """As many as there is room for, and how many were left out."""
    ends = accumulate(map(len, parts))
    kept = [part for part, end in zip(parts, ends, strict=True) if end <= ROOM]
    left = len(parts) - len(kept)
    return [*kept, f"\nAnd {left} failed checks more."] if left else kept


def literal(words: str) -> str:
    """Words that mean themselves in Markdown, in its tables and in HTML."""
    return re.sub(r"[^\w ,()/'-]|_", lambda found: f"&#{ord(found[0])};", clean(words))
