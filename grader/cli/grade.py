"""Define the command that grades one submission, or a class."""

import os
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from grader.cli.shared import (
    Confinement,
    CourseFile,
    SecretSeed,
    check_todos,
    console,
    grade_one,
    open_path,
    refuse_ignored,
    require_checkout,
    require_file_target,
    require_folder_target,
)
from grader.errors import Stop
from grader.judge.course import read_course
from grader.judge.result import Result
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wall.outer import MOST_MEMORY, WHOLE, go_on_within
from grader.judge.wall.starting import count_cores, start_ahead, start_server_ahead
from grader.report.files import write_json
from grader.report.terminal import Printer, show_isolation

FOR_ONE = ("json", "ci", "at_least")  # options that count for one submission alone

app = typer.Typer()


@dataclass(frozen=True)
class Output:
    """The files to write about one submission, and the points for exit status 0."""

    out: Path | None = None
    json: Path | None = None
    at_least: int | None = None


@app.command("grade")
def grade_command(
    context: typer.Context,
    path: Annotated[
        Path | None,
        typer.Argument(help="The submission: folder, file or zip; the shipped trees if left out."),
    ] = None,
    class_: Annotated[
        bool,
        typer.Option("--class", hidden=True, help="PATH holds submissions: a folder or zip."),
    ] = False,
    out: Annotated[
        Path | None, typer.Option(help="Write NAME.json and a report, NAME.html, into this folder.")
    ] = None,
    json: Annotated[
        Path | None, typer.Option(help="Write the result of one submission here as JSON.")
    ] = None,
    reference: Annotated[
        Path | None, typer.Option(help="The complete tree; the kit's own if left out.")
    ] = None,
    jobs: Annotated[
        int,
        typer.Option(
            min=0, help="Checks, or submissions of a class, at a time; 0 for one per core."
        ),
    ] = 0,
    isolation: Confinement = "auto",
    seed: SecretSeed = None,
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
    ci: Annotated[
        Path | None, typer.Option(help="For CI: write reports into this folder, and notify GitHub.")
    ] = None,
    at_least: Annotated[
        int | None, typer.Option(min=0, help="Points for exit status 0, instead of full marks.")
    ] = None,
    course: CourseFile = None,
) -> None:
    """Grade a submission; a class has `grader class grade`.

    Exit status 0: full marks, 1: less, 2: could not be graded.
    """
    refuse_what_is_ignored(context, path, class_)
    taken = read_course(course)
    complete = reference or shipped_reference()
    own = complete is None  # a student's copy grades only its own tree
    only, output = check_todos(todo, taken), Output(out, json, at_least)
    options = Options(complete, isolation, only, seed, trusted=own, course=taken)
    refuse_outputs(path, class_, output, options)
    jobs_of_one = jobs or count_cores()
    if path is None:
        demonstrate(options)
        return
    if class_:
        # Imported here: students have none of it, and it would add 80 ms to every start.
        from grader.classroom.job import JOB

        start_server_ahead(JOB)
        from grader.classroom.grading import ClassOptions
        from grader.cli.classes import grade_folder

        grade_folder(path, ClassOptions(options, out, jobs))
        return
    if not own and context.obj:
        go_on_within(replace(WHOLE, memory=MOST_MEMORY * jobs_of_one))
    start_ahead(jobs_of_one)  # the worker loads while this process does
    options = replace(options, jobs=jobs_of_one)
    if ci is not None:
        grade_in_ci(path, ci, output, options)
    with open_path(path, taken.modules) as folder:
        replays = None if out is None else out / folder.resolve().name
        result = grade_and_show(folder, options, replays)
    finish(result, output)


def refuse_what_is_ignored(context: typer.Context, path: Path | None, class_: bool) -> None:
    """Raise Stop for an ignored option."""
    if path is None and class_:
        raise Stop("--class needs the submissions: name a folder or a zip of them")
    if class_ and not find_spec("grader.classroom"):
        raise Stop("--class needs the whole kit, and this is the students' grader: leave it out")
    if path is None:
        refuse_ignored(context, (*FOR_ONE, "out", "jobs"), "without a submission: name one")
    elif class_:
        refuse_ignored(context, FOR_ONE, "with --class, which is for more than one submission")


def refuse_outputs(path: Path | None, class_: bool, output: Output, options: Options) -> None:
    """Raise Stop if a file cannot be written or `at_least` cannot be reached."""
    require_folder_target(output.out, "--out")
    require_file_target(output.json, "--json")
    if class_ and path is not None and output.out is not None:
        folder, out = path.resolve(), output.out.resolve()
        if out.is_relative_to(folder):
            raise Stop(f"--out {output.out} is in the class, {path}: name a folder outside it")
    wanted = [todo for todo in options.course.rubric.main_todos if options.wants(todo)]
    most = sum(todo.max_points for todo in wanted)
    if output.at_least is not None and output.at_least > most:
        words = f"can never be reached: there are {most} points here"
        raise Stop(f"--at-least {output.at_least} {words}")


def grade_and_show(path: Path, options: Options, replays: Path | None) -> Result:
    result = grade_one(path, options, replays)
    Printer(console).print(result)
    show_isolation(result, console)
    return result


def finish(result: Result, output: Output) -> NoReturn:
    """Write the output, and end with the exit status for the points."""
    if output.json is not None:
        write_json(result, output.json)
    if output.out is not None:
        from grader.report.html import write_report  # imported here, since it is slow

        write_json(result, output.out / f"{result.submission}.json")
        write_report(result, output.out / f"{result.submission}.html")
    at_least = output.at_least
    enough = result.has_full_marks if at_least is None else result.points >= at_least
    raise typer.Exit(0 if enough else 1)


def grade_in_ci(path: Path, folder: Path, output: Output, options: Options) -> NoReturn:
    """Grade for a CI system, which must not read printed text as commands."""
    from grader.report.ci import is_free_folder, name_after_repository, tell_github, write_reports
    from grader.report.sinks.github import stop_commands

    if not is_free_folder(folder):
        raise Stop(f"{folder} is there already, and reports need a folder of their own: remove it")
    with stop_commands(os.environ), open_path(path, options.course.modules) as tree:
        result = grade_and_show(tree, options, folder / "replays")
    result = name_after_repository(result, os.environ)
    write_reports(result, folder)
    tell_github(result, path, os.environ)
    finish(result, output)


def demonstrate(options: Options) -> None:
    """Grade the shipped trees, to show that the grader works here."""
    require_checkout("grade", ", or name a submission")
    for name in ("solution", "starter"):
        console.rule(name)
        result = grade_one(KIT / name, replace(options, trusted=True))
        Printer(console).print(result)
    show_isolation(result, console)
