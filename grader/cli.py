"""The command line: `python -m grader COMMAND`."""

import sys
from pathlib import Path
from typing import Annotated, NoReturn

import msgspec
import typer
from rich.console import Console

from grader.judge.grade import KIT, Isolation, Options, grade, shipped_reference
from grader.judge.result import Result
from grader.judge.submission import CannotGrade
from grader.report.terminal import show

app = typer.Typer(
    help="Grades submissions of the physics-engine assignment.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
console = Console(highlight=False, markup=False)


@app.command("grade")
def grade_command(
    path: Annotated[
        Path | None, typer.Argument(help="The submission; the shipped trees if left out.")
    ] = None,
    json: Annotated[Path | None, typer.Option(help="Write the result here as JSON.")] = None,
    reference: Annotated[
        Path | None, typer.Option(help="The complete tree; the kit's own if left out.")
    ] = None,
    isolation: Annotated[Isolation, typer.Option(help="How much confinement to insist on.")] = "auto",
    seed: Annotated[int | None, typer.Option(help="A secret seed for the property tests.")] = None,
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
) -> None:
    """Grade a submission. Exit status 0: full marks, 1: less, 2: could not be graded."""
    options = Options(reference or shipped_reference(), isolation, frozenset(todo or ()), seed)
    if path is None:
        demonstrate(options)
        return
    result = graded(path, options)
    show(result, console)
    if json is not None:
        json.write_bytes(msgspec.json.format(msgspec.json.encode(result)) + b"\n")
    raise typer.Exit(0 if result.points == result.max_points else 1)


def demonstrate(options: Options) -> None:
    """The shipped trees, to show that the grader works here."""
    for name in ("solution", "starter"):
        console.rule(name)
        show(graded(KIT / name, options), console)


def graded(path: Path, options: Options) -> Result:
    try:
        return grade(path, options)
    except CannotGrade as error:
        stop(str(error))


def stop(message: str) -> NoReturn:
    Console(stderr=True, highlight=False, markup=False).print(f"cannot grade: {message}")
    raise typer.Exit(2)


@app.command("sync")
def sync_command(
    check: Annotated[bool, typer.Option("--check", help="Only say what differs.")] = False,
) -> None:
    """Carry the solution's given code over into the starter."""
    from grader.maintain.sync import OutOfStep, sync

    try:
        changes = sync(KIT / "solution", KIT / "starter", write=not check)
    except OutOfStep as error:
        stop(str(error))
    for change in changes:
        console.print(change)
    if not changes:
        console.print("starter and solution are in step")
    raise typer.Exit(1 if check and changes else 0)


@app.command("verify")
def verify_command(
    jobs: Annotated[int, typer.Option(help="Members graded at a time; 0 for one per core.")] = 0,
    only: Annotated[str, typer.Option(help="Only members whose kind/name contains this.")] = "",
) -> None:
    """Grade the bank of wrong, right and hostile submissions: the grader is graded."""
    from grader.maintain.verify import verify

    raise typer.Exit(0 if verify(jobs, only, console).sound else 1)


@app.command("bench")
def bench_command(
    rounds: Annotated[int, typer.Option(help="How often each is measured, in turns.")] = 5,
) -> None:
    """Measure what a grade costs, and what the isolation adds to it."""
    from grader.maintain.bench import bench

    bench(rounds, console)


def main() -> None:
    app(prog_name="grader")


if __name__ == "__main__":
    sys.exit(main())
