"""Define the commands that release, verify and measure the kit."""

import random
from pathlib import Path
from typing import Annotated

import typer

from grader.cli.shared import (
    CourseFile,
    check_todos,
    console,
    print_note,
    print_notes,
    require_checkout,
    require_folder_target,
)
from grader.judge.course import read_course
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT

MAKING_TAB = "making the page for a browser (minutes; seconds if nothing changed)"
FRESH = "Grade every member of the bank, also those that build/verify holds a result of."

MembersAtATime = Annotated[
    int, typer.Option(min=0, help="Submissions graded at a time; 0 for one per core.")
]
Cffi = Annotated[
    Path | None, typer.Option(help="The wheel of cffi for Pyodide, which the page's pymunk needs.")
]

app = typer.Typer()


@app.command("sync")
def sync_command(
    check: Annotated[bool, typer.Option("--check", help="Only say what differs.")] = False,
) -> None:
    """Carry the solution's given code over into the starter."""
    require_checkout("sync")
    from grader.bank.sync import sync

    lines = sync(KIT / "solution", KIT / "starter", not check, KIT / "course.toml")
    for line in lines or ["nothing to do: starter and solution are in step"]:
        console.print(line)
    named = {todo.id for todo in read_course().rubric.todos}
    left = [todo.id for todo in load_rubric().todos if todo.id not in named]
    if left and not check:
        console.print(f"course.toml does not name TODO {', '.join(left)}: no student has to do it")
    raise typer.Exit(1 if check and lines else 0)


@app.command("verify")
def verify_command(
    jobs: MembersAtATime = 0,
    only: Annotated[str, typer.Option(help="Only members whose kind/name contains this.")] = "",
    fresh: Annotated[bool, typer.Option("--fresh", help=FRESH)] = False,
    write: Annotated[Path | None, typer.Option(help="Only write the members here.")] = None,
    course: CourseFile = None,
) -> None:
    """Grade the bank of wrong, right and hostile submissions, to test the grader.

    Unchanged members with a result in build/verify are not graded again.
    """
    require_checkout("verify")
    from grader.bank.verify import verify, write_members

    if write is not None:
        for path in write_members(only, write):
            console.print(str(path))
        return
    sound = verify(jobs, only, console, fresh, read_course(course)).sound
    raise typer.Exit(0 if sound else 1)


@app.command("release")
def release_command(
    out: Annotated[Path, typer.Option(help="Where to put it.", show_default="build/release")] = KIT
    / "build"
    / "release",
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Record and prove all again, also what is kept.")
    ] = False,
    cffi: Cffi = None,
    course: CourseFile = None,
) -> None:
    """Make the archive for students, and check that it does not give the solution away.

    With Node.js and a network it also makes the page of `grader tab`.
    Exit status 0: success, 2: failure.
    """
    require_checkout("release")
    from grader.release.build import release
    from grader.release.tab_page import add_tab

    require_folder_target(out, "--out")
    for path in release(out, console, fresh, read_course(course)):
        print_note(f"made {path}")
    with console.status(MAKING_TAB):
        notes = add_tab(out / "tab", read_course(course), cffi)
    print_notes(notes)


@app.command("tab")
def tab_command(
    out: Annotated[Path, typer.Option(help="Where to put it.", show_default="build/tab")] = KIT
    / "build"
    / "tab",
    cffi: Cffi = None,
    course: CourseFile = None,
) -> None:
    """Make the lab as a page for a browser, without installation.

    Any web server can serve the folder. Needs Node.js, and the network the first time.
    """
    require_checkout("tab")
    from grader.release.tab_page import make_tab

    require_folder_target(out, "--out")
    with console.status(MAKING_TAB):
        made = make_tab(out, read_course(course), cffi)
    print_notes([f"made {path}" for path in made])


@app.command("mutants")
def mutants_command(
    count: Annotated[int, typer.Option(min=0, help="How many; 0 for all of them.")] = 200,
    seed: Annotated[int, typer.Option(help="Chooses which.")] = 1,
    jobs: MembersAtATime = 0,
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
    alone: Annotated[
        bool, typer.Option("--alone", help="A mutant's own TODO only, and no names: much faster.")
    ] = False,
) -> None:
    """Change the solution in small ways, and test whether the checks notice.

    Exit status 0: every mutant lost points in its own TODO alone, 1: some did not.
    With --alone, other TODOs and the names of mistakes are not tested.

    A survivor with other results than the solution's is a wrong submission with full marks: put it
    into tests/bank/wrong, named by its mistake, and make a check stricter until `verify` agrees.
    One with the same results is listed, with its reason, in grader/bank/equivalent.toml.
    """
    require_checkout("mutants")
    from grader.bank.mutants import list_mutants, run_mutants

    mutants = list_mutants(check_todos(todo))
    if count:
        mutants = random.Random(seed).sample(mutants, min(count, len(mutants)))
    outcomes = run_mutants(mutants, jobs, console, alone)
    raise typer.Exit(1 if any(each.complaint for each in outcomes) else 0)


@app.command("bench")
def bench_command(
    rounds: Annotated[int, typer.Option(min=1, help="How often each figure is measured.")] = 5,
    size: Annotated[int, typer.Option("--class", min=1, help="Submissions in the class.")] = 6,
    against: Annotated[
        Path | None,
        typer.Option(exists=True, file_okay=False, help="Another checkout, measured in turns."),
    ] = None,
) -> None:
    """Measure a student's waiting time, and the cost of a grade and a class.

    A round takes about a minute, the first one two more; twice as long with --against.
    """
    require_checkout("bench")
    from grader.bench.figures import bench

    bench(rounds, size, console, against)
