"""The command line: `python -m grader COMMAND`."""

import _thread
import os
import signal
import sys
import threading
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from grader.cli import export as report
from grader.cli import student
from grader.cli.shared import (
    CourseFile,
    console,
    course_in,
    graded,
    known_todos,
    needs_checkout,
    refuse_ignored,
    say_why,
    stop,
    submission_at,
)
from grader.judge.grade import KIT, Options, shipped_reference
from grader.judge.isolation import Isolation
from grader.judge.result import Result
from grader.judge.submission import CannotGrade
from grader.report.files import write_json
from grader.report.terminal import show, show_isolation

FOR_ONE = ("json", "ci", "at_least")  # options that count for one submission alone
ENDINGS = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
FOR_CLASS = ("jobs", "roster", "adjust", "cluster")  # for a class alone

app = typer.Typer(
    help="Grades submissions of the physics-engine assignment.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


@app.command("grade")
def grade_command(
    context: typer.Context,
    path: Annotated[
        Path | None,
        typer.Argument(help="The submission: folder, file or zip. Left out: the shipped trees."),
    ] = None,
    class_: Annotated[
        bool, typer.Option("--class", help="PATH holds submissions: a folder or zip of them.")
    ] = False,
    out: Annotated[
        Path | None, typer.Option(help="Write NAME.json into this folder; a class always does.")
    ] = None,
    json: Annotated[Path | None, typer.Option(help="Write the one result here as JSON.")] = None,
    reference: Annotated[
        Path | None, typer.Option(help="The complete tree; the kit's own if left out.")
    ] = None,
    jobs: Annotated[
        int, typer.Option(help="For a class: submissions at a time; 0 for one per core.")
    ] = 0,
    isolation: Annotated[Isolation, typer.Option(help="Confinement to insist on.")] = "auto",
    seed: Annotated[
        int | None, typer.Option(help="A secret seed: other numbers in every check.")
    ] = None,
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
    ci: Annotated[
        Path | None, typer.Option(help="For CI: write its reports into this folder, tell GitHub.")
    ] = None,
    at_least: Annotated[
        int | None, typer.Option(min=0, help="Points for exit status 0, instead of full marks.")
    ] = None,
    roster: Annotated[
        Path | None, typer.Option(help="For a class: its list, as the LMS exports it.")
    ] = None,
    adjust: Annotated[
        Path | None, typer.Option(help="For a class: late days and points set by hand, as TOML.")
    ] = None,
    cluster: Annotated[
        str, typer.Option(help="For a class: grade on the Dask cluster at this address.")
    ] = "",
    course: CourseFile = None,
) -> None:
    """Grade a submission, or a class of them.

    Exit status 0: full marks (for a class: all graded), 1: less, 2: could not be graded.
    """
    refuse_what_is_ignored(context, path, class_, cluster)
    chosen = course_in(course)
    complete = reference or shipped_reference()
    own = complete is None  # a student's copy: there is nothing but their own work
    options = Options(
        complete, isolation, known_todos(todo, chosen), seed, trusted=own, course=chosen
    )
    if path is None:
        demonstrate(options)
    elif class_:
        grade_folder(path, options, out, jobs, roster, adjust, cluster)
    elif ci is not None:
        grade_in_ci(path, ci, out, json, at_least, options)
    else:
        with submission_at(path, chosen.modules) as folder:
            replays = None if out is None else out / folder.resolve().name
            result = shown(folder, options, replays)
        finish(result, out, json, at_least)


def refuse_what_is_ignored(
    context: typer.Context, path: Path | None, class_: bool, cluster: str
) -> None:
    """Each way of grading takes options that the others would pass over in silence."""
    if path is None and class_:
        stop("--class needs the submissions: name a folder or a zip of them")
    if path is None:
        refuse_ignored(context, (*FOR_ONE, *FOR_CLASS, "out"), "without a submission: name one")
    elif class_:
        refuse_ignored(context, FOR_ONE, "with --class, which is for more than one submission")
    else:
        refuse_ignored(context, FOR_CLASS, "without --class, which grades a folder or zip of them")
    if cluster:
        refuse_ignored(context, ("jobs",), "with --cluster: its workers say how many at a time")


def shown(path: Path, options: Options, replays: Path | None) -> Result:
    """The result of one submission, printed."""
    result = graded(path, options, replays)
    show(result, console)
    show_isolation(result, console)
    return result


def finish(result: Result, out: Path | None, json: Path | None, at_least: int | None) -> NoReturn:
    """Write what is wanted, and end with the status that the points deserve."""
    if json is not None:
        write_json(result, json)
    if out is not None:
        from grader.report.html import write_report  # only here: it takes its time

        write_json(result, out / f"{result.submission}.json")
        write_report(result, out / f"{result.submission}.html")
    most = result.max_points
    if at_least is not None and at_least > most:
        stop(f"--at-least {at_least} can never be reached: there are {most} points here")
    enough = result.complete if at_least is None else result.points >= at_least
    raise typer.Exit(0 if enough else 1)


def grade_in_ci(
    path: Path,
    folder: Path,
    out: Path | None,
    json: Path | None,
    at_least: int | None,
    options: Options,
) -> NoReturn:
    """What is printed for people is kept from being read as commands."""
    from grader.report.ci import named_after_repository, own_folder, tell_github, write_reports
    from grader.report.sinks.github import commands_stopped

    if not own_folder(folder):
        stop(f"{folder} is there already, and reports need a folder of their own: remove it")
    with commands_stopped(os.environ):
        result = shown(path, options, folder / "replays")
    result = named_after_repository(result, os.environ)
    write_reports(result, folder)
    tell_github(result, path, os.environ)
    finish(result, out, json, at_least)


def grade_folder(
    path: Path,
    options: Options,
    out: Path | None,
    jobs: int,
    roster: Path | None,
    adjust: Path | None,
    cluster: str,
) -> NoReturn:
    if not find_spec("grader.classroom"):
        stop("this is the students' grader, and --class needs the whole kit: leave it out")
    # Imported here: students have none of it, and it would add 80 ms to every start.
    from grader.classroom.grading import ClassOptions, run_class

    try:
        run = run_class(path, ClassOptions(options, out, jobs, roster, adjust, cluster), console)
    except (CannotGrade, OSError) as error:
        stop(str(error))
    except KeyboardInterrupt:
        stop("stopped; what is graded stays, and the same command goes on from there")
    raise typer.Exit(2 if any(outcome.mark is None for outcome in run.outcomes) else 0)


def demonstrate(options: Options) -> None:
    """The shipped trees, to show that the grader works here."""
    needs_checkout("grade", ", or name a submission")
    for name in ("solution", "starter"):
        console.rule(name)
        result = graded(KIT / name, replace(options, trusted=True))
        show(result, console)
    show_isolation(result, console)


def interrupt_again(ignored: "sys.UnraisableHookArgs") -> None:
    """Let Ctrl-C count where it comes while a callback runs, as that of a garbage collection.

    Python cannot raise it there and only tells of it. A moment later it can. On a busy machine that
    moment may be over before this function is, which Python would only tell of as well.
    """
    if not issubclass(ignored.exc_type, KeyboardInterrupt):
        sys.__unraisablehook__(ignored)
        return
    while True:
        try:
            later = threading.Timer(0.05, interrupt)
            later.daemon = True
            later.start()
            return
        except KeyboardInterrupt:
            continue


def interrupt() -> None:
    """As Ctrl-C does; from another thread, where it can, also in the middle of a wait."""
    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
    else:
        _thread.interrupt_main()


def end_like_ctrl_c() -> None:
    """Told to end, or the terminal closed: all is put away, as after Ctrl-C, and so only once."""

    def stopped(number: int, _: object) -> NoReturn:
        for name in ENDINGS:
            signal.signal(name, signal.SIG_IGN)
        raise KeyboardInterrupt

    for name in ENDINGS:
        if signal.getsignal(name) == signal.SIG_DFL:  # nohup has a terminal's end ignored
            signal.signal(name, stopped)


def main() -> None:
    sys.unraisablehook = interrupt_again
    end_like_ctrl_c()
    app.add_typer(student.app)
    app.add_typer(report.app)
    if find_spec("grader.classroom"):  # students get none of these folders
        from grader.cli.classroom import app as classroom
        from grader.cli.dev import app as dev
        from grader.cli.questions import app as questions

        app.add_typer(classroom)
        app.add_typer(dev)
        app.add_typer(questions)
    else:
        from grader.cli.practice import app as practice

        app.add_typer(practice)
    try:
        app(prog_name="grader")
    except OSError as error:  # exit status 1 would say that points are missing
        say_why(f"{error}. Is there space, and a right to write?", "go on")
        sys.exit(2)
