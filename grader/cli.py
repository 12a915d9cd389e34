"""The command line: `python -m grader COMMAND`."""

from pathlib import Path
from typing import Annotated, NoReturn

import msgspec
import typer
from rich.console import Console

from grader.classroom import nbgrader, notebooks, roster  # noqa: F401  notebooks adds commands
from grader.classroom.batch import grade_class, show_class
from grader.judge.grade import KIT, Options, grade, shipped_reference
from grader.judge.isolation import Isolation
from grader.judge.result import Result
from grader.judge.rubric import CHECKS, load_rubric
from grader.judge.submission import CannotGrade
from grader.report.files import write_json
from grader.report.terminal import show, show_isolation, show_next

app = typer.Typer(
    help="Grades submissions of the physics-engine assignment.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.add_typer(nbgrader.app, name="nbgrader")
app.command("marks")(roster.marks_command)
console = Console(highlight=False, markup=False)


@app.command("grade")
def grade_command(
    path: Annotated[
        Path | None, typer.Argument(help="The submission; the shipped trees if left out.")
    ] = None,
    class_: Annotated[
        bool, typer.Option("--class", help="PATH is a folder of submissions, a folder each.")
    ] = False,
    out: Annotated[Path | None, typer.Option(help="Write NAME.json into this folder.")] = None,
    json: Annotated[Path | None, typer.Option(help="Write the one result here as JSON.")] = None,
    reference: Annotated[
        Path | None, typer.Option(help="The complete tree; the kit's own if left out.")
    ] = None,
    jobs: Annotated[int, typer.Option(help="Submissions at a time; 0 for one per core.")] = 0,
    isolation: Annotated[Isolation, typer.Option(help="Confinement to insist on.")] = "auto",
    seed: Annotated[int | None, typer.Option(help="A secret seed for the property tests.")] = None,
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
) -> None:
    """Grade a submission, or a class of them.

    Exit status 0: full marks (for a class: all graded), 1: less, 2: could not be graded.
    """
    options = Options(
        reference or shipped_reference(), isolation, only=known_todos(todo), seed=seed
    )
    if path is None:
        demonstrate(options)
    elif class_:
        grade_folder(path, out, options, jobs)
    else:
        grade_one(path, out, json, options)


def grade_one(path: Path, out: Path | None, json: Path | None, options: Options) -> NoReturn:
    result = graded(path, options)
    show(result, console)
    show_isolation(result, console)
    if json is not None:
        write_json(result, json)
    if out is not None:
        write_json(result, out / f"{result.submission}.json")
    raise typer.Exit(0 if result.points == result.max_points else 1)


def grade_folder(path: Path, out: Path | None, options: Options, jobs: int) -> NoReturn:
    try:
        outcomes = grade_class(path, out, options, jobs, console)
    except CannotGrade as error:
        stop(str(error))
    show_class(outcomes, console)
    raise typer.Exit(2 if any(outcome.result is None for outcome in outcomes) else 0)


def demonstrate(options: Options) -> None:
    """The shipped trees, to show that the grader works here."""
    for name in ("solution", "starter"):
        console.rule(name)
        result = graded(KIT / name, options)
        show(result, console)
    show_isolation(result, console)


def graded(path: Path, options: Options) -> Result:
    try:
        return grade(path, options)
    except CannotGrade as error:
        stop(str(error))


def known_todos(todos: list[str] | None) -> frozenset[str]:
    known = [todo.id for todo in load_rubric().todos]
    for todo in todos or ():
        if todo not in known:
            stop(f"there is no TODO {todo}; there are {', '.join(known)}")
    return frozenset(todos or ())


@app.command("check")
def check_command(
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
    path: Annotated[Path, typer.Argument(help="A folder inside your tree.")] = Path("."),
) -> None:
    """Show what stands in your own tree, and what to do next. Exit status as for `grade`."""
    folder = own_tree(path)
    result = graded(folder, Options(reference=None, only=known_todos(todo)))
    show(result, console)
    show_next(result, console)
    raise typer.Exit(0 if result.points == result.max_points else 1)


def own_tree(path: Path) -> Path:
    """The student's tree around `path`: the folder that holds the mini engine."""
    for folder in [path.resolve(), *path.resolve().parents]:
        if (folder / "mini_engine").is_dir() or (folder / "mini_engine.py").is_file():
            return folder
    stop(f"there is no mini_engine in {path.resolve()} or above it: go to the folder handed out")


@app.command("hint")
def hint_command(
    todo: Annotated[str, typer.Option(help="The TODO you are at.")],
    level: Annotated[int, typer.Option(min=1, max=3, help="How much to tell.")] = 1,
) -> None:
    """Give a hint: first a question, then the idea, then nearly the code."""
    known_todos([todo])
    hints = msgspec.toml.decode((CHECKS / "hints.toml").read_bytes(), type=dict[str, list[str]])
    for number, words in enumerate(hints.get(todo, [])[:level], 1):
        console.print(f"{number}  {words}")
    if level < len(hints.get(todo, [])):
        console.print(f"More: python -m grader hint --todo {todo} --level {level + 1}")


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


@app.command("mutants")
def mutants_command(
    count: Annotated[int, typer.Option(min=0, help="How many; 0 for all of them.")] = 200,
    seed: Annotated[int, typer.Option(help="Chooses which.")] = 1,
    jobs: Annotated[int, typer.Option(help="Mutants graded at a time; 0 for one per core.")] = 0,
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
) -> None:
    """Change the solution in small ways, and see whether the checks notice.

    Exit status 0: every mutant lost points in its own TODO alone, 1: not so.
    """
    from grader.maintain.mutants import campaign

    only = known_todos(todo)
    raise typer.Exit(0 if campaign(count, seed, jobs, only, console).sound else 1)


@app.command("bench")
def bench_command(
    rounds: Annotated[int, typer.Option(help="How often each is measured, in turns.")] = 5,
) -> None:
    """Measure what a grade costs, and what the isolation adds to it."""
    from grader.maintain.bench import bench

    bench(rounds, console)


def main() -> None:
    app(prog_name="grader")
