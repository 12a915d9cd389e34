"""The result in a terminal: one line per TODO, and a few for each check that is not there yet."""

from rich.console import Console
from rich.text import Text

from grader.judge.isolation import unconfined
from grader.judge.result import CheckResult, Result, TodoResult

LABELS = {
    "passed": ("PASSED", "green"),
    "not yet": ("NOT YET", "yellow"),
    "not started": ("NOT STARTED", "bright_black"),
    "waiting": ("WAITING", "bright_black"),
    "error": ("ERROR", "red"),
}
WIDTH = 12  # of the column of states


def show(result: Result, console: Console) -> None:
    """Print the whole result."""
    for todo in result.todos:
        show_todo(todo, console)
    line = Text(f"{clean(result.submission)}: {result.points} / {result.max_points}", style="bold")
    if result.bonus:
        line.append(f"  and {result.bonus} bonus")
    console.print(line)


def show_isolation(result: Result, console: Console) -> None:
    """Print what held the submission in, and what did not."""
    console.print(Text(f"isolation: {', '.join(result.isolation)}", style="bright_black"))
    if lacking := unconfined(result.isolation):
        words = f"not confined here: {', '.join(lacking)}. Grade only submissions you trust."
        console.print(Text(words, style="yellow"))


def show_todo(todo: TodoResult, console: Console) -> None:
    label, style = LABELS[todo.state]
    line = Text(label.ljust(WIDTH), style=style)
    line.append(f"{todo.id:<6}{todo.title:<48}", style="default")
    line.append(f"{todo.points:>3} / {todo.max_points}", style="default")
    console.print(line)
    for check in todo.checks:
        if check.state in ("not yet", "error"):
            show_check(todo, check, console)


def show_check(todo: TodoResult, check: CheckResult, console: Console) -> None:
    console.print(Text(f"  {check.title}  ({check.points} / {check.max_points})", style="bold"))
    for line in reasons(check, f", TODO {todo.id}"):
        console.print(Text(f"    {line}"), soft_wrap=True)


def reasons(check: CheckResult, task: str = "") -> list[str]:
    """Why a check is not passed, a line each; `task` stands behind the place to look at."""
    place = f"{check.where.file}:{check.where.line}{task}" if check.where else ""
    words = (
        ("We ran", check.ran),
        ("Expected", check.expected),
        ("Got", check.got),
        ("Meaning", check.meaning),
        ("Look at", place),
    )
    return [f"{name:<9} {clean(each)}" for name, each in words if each]


def show_next(result: Result, console: Console) -> None:
    """The one thing to do next: the first TODO that is not passed and waits for no other."""
    for todo in result.todos:
        if todo.state in ("not yet", "error", "not started") and todo.id != "whole":
            file = next((f" ({c.where.file}:{c.where.line})" for c in todo.checks if c.where), "")
            console.print(Text(f"Next: TODO {todo.id}, {todo.title}{file}", style="bold"))
            console.print(f"  check it alone: python -m grader check --todo {todo.id}")
            console.print(f"  a hint:         python -m grader hint --todo {todo.id}")
            return


def clean(words: str) -> str:
    """A submission's words on one line, with nothing that a terminal would obey."""
    return "".join(c if c.isprintable() else " " for c in words)[:400]
