"""Grading every submission of a folder, several at a time; one crash touches no other."""

import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from grader.judge.grade import Options, grade
from grader.judge.result import Result
from grader.judge.submission import CannotGrade
from grader.report.files import write_json
from grader.report.terminal import clean


@dataclass(frozen=True)
class Outcome:
    """One submission of a class: its result, or why there is none."""

    name: str
    result: Result | None
    trouble: str = ""


def submissions_in(folder: Path) -> list[Path]:
    """The submissions of a class: one folder each, hidden ones left out."""
    if not folder.is_dir():
        raise CannotGrade(f"there is no folder of submissions at {folder}")
    found = sorted(p for p in folder.iterdir() if p.is_dir() and not p.name.startswith("."))
    if not found:
        raise CannotGrade(f"{folder} holds no submission: each must be a folder of its own")
    return found


def grade_class(
    folder: Path, out: Path | None, options: Options, jobs: int, console: Console
) -> list[Outcome]:
    """Grade them all; with `out`, one NAME.json each is written as soon as it is there."""
    paths = submissions_in(folder)
    columns = (TextColumn("grading"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    outcomes = []
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("", total=len(paths))
        for outcome in grade_all(paths, options, jobs):
            outcomes.append(outcome)
            progress.advance(task)
            if out is not None and outcome.result is not None:
                write_json(outcome.result, out / f"{outcome.name}.json")
    return sorted(outcomes, key=lambda outcome: outcome.name)


def grade_all(paths: list[Path], options: Options, jobs: int) -> Iterator[Outcome]:
    """In processes of their own, in the order in which they end."""
    context = get_context("spawn")
    with ProcessPoolExecutor(jobs or os.cpu_count(), mp_context=context) as pool:
        futures = {pool.submit(grade, path, options): path.name for path in paths}
        for future in as_completed(futures):
            name = futures[future]
            try:
                yield Outcome(name, future.result())
            except Exception as error:  # this one submission; the others go on
                yield Outcome(name, None, f"{type(error).__name__}: {error}")


def show_class(outcomes: list[Outcome], console: Console) -> None:
    table = Table("submission", "points", "not passed")
    for outcome in outcomes:
        if outcome.result is None:
            table.add_row(clean(outcome.name), "none", clean(outcome.trouble))
            continue
        left = [todo.id for todo in outcome.result.todos if todo.state != "passed"]
        points = f"{outcome.result.points} / {outcome.result.max_points}"
        table.add_row(clean(outcome.name), points, ", ".join(left))
    console.print(table)
