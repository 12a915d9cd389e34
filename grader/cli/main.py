"""Run the command line, `python -m grader COMMAND`."""

import _thread
import signal
import sys
import threading
import traceback
from collections.abc import Collection, Sequence
from copy import copy
from importlib.util import find_spec
from typing import Any, NoReturn

import typer
from rich.console import Console
from typer.core import TyperGroup

from grader.errors import Stop

ENDINGS = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
FOR_INSTRUCTORS = ("grade", "release", "gradescope")  # commands that --help lists beside the groups
EPILOG = (
    "handouts/instructor/term.md describes a term. With nbgrader: grader nbgrader --help. "
    "Students' commands work here too: check, hint, hand-in. All others: grader dev --help"
)


class Commands(TyperGroup):
    """Commands that turn an error into a sentence and an exit status."""

    def invoke(self, context: Any) -> Any:
        try:
            return super().invoke(context)
        except Stop as error:
            say_why(error.cannot, str(error))
            raise typer.Exit(error.status) from error
        except OSError as error:  # exit status 1 would say that points are missing
            what = f"{error.filename}: {error.strerror}" if error.filename else str(error)
            say_why(Stop.cannot, f"{what}. Check free space and write permission.")
            raise typer.Exit(Stop.status) from error


def say_why(cannot: str, words: str) -> None:
    Console(stderr=True, highlight=False, markup=False).print(f"cannot {cannot}: {words}")


def interrupt_again(ignored: "sys.UnraisableHookArgs") -> None:
    """Raise Ctrl-C again if it came during a callback, such as garbage collection.

    Python would only print it, so a timer raises it a moment later. On a busy machine, this
    function may still be running and starts another timer.
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
    """Interrupt the main thread as Ctrl-C does, if possible during a wait."""
    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
    else:
        _thread.interrupt_main()


def end_like_ctrl_c() -> None:
    """Clean up once, as after Ctrl-C, when the system or the terminal ends this process."""

    def end(number: int, _: object) -> NoReturn:
        for name in ENDINGS:
            signal.signal(name, signal.SIG_IGN)
        raise KeyboardInterrupt

    for name in ENDINGS:
        if signal.getsignal(name) == signal.SIG_DFL:  # nohup ignores the end of a terminal
            signal.signal(name, end)


def make_app(words: Sequence[str] = ()) -> typer.Typer:
    """Return the command line that understands these words; without words, all commands.

    A student waits for every module that is loaded, so `check` loads only what it needs.
    """
    from grader.cli import student

    is_kit = find_spec("grader.classroom") is not None  # students have no such folder
    whole = typer.Typer(
        cls=Commands,
        help="Grade the physics-engine lab." if is_kit else "Check your physics lab.",
        no_args_is_help=is_kit,  # students get the guide
        add_completion=False,
        pretty_exceptions_enable=False,
    )
    if words and words[0] in [each.name for each in student.app.registered_commands]:
        whole.add_typer(student.app)
        return whole
    from grader.cli import export, grade

    if is_kit:
        from grader.cli import classes, classroom, dev, questions

        apps = [grade.app, export.app, classroom.app, dev.app, questions.app]
        whole.add_typer(classes.app)
        whole.add_typer(make_dev_app(apps), name="dev", hidden=True)
        whole.add_typer(hide_commands(student.app, ()))
        for each in apps:
            whole.add_typer(hide_commands(each, FOR_INSTRUCTORS))
        whole.info.epilog = EPILOG
    else:
        from grader.cli import guide, practice

        whole.callback(invoke_without_command=True)(guide.guide_command)
        for each in [grade.app, export.app]:  # for CI
            whole.add_typer(hide_commands(each, ()))
        for each in [student.app, practice.app]:
            whole.add_typer(each)
        whole.info.epilog = "Without a command, the guide shows the next task and checks each save."
    return whole


def make_dev_app(apps: Collection[typer.Typer]) -> typer.Typer:
    """Return the group of commands that `--help` omits."""
    maintainers = typer.Typer(help="For maintainers of the kit.", no_args_is_help=True)
    every = [each for app in apps for each in app.registered_commands]
    maintainers.registered_commands += [x for x in every if x.name not in FOR_INSTRUCTORS]
    return maintainers


def hide_commands(whole: typer.Typer, shown: Collection[str]) -> typer.Typer:
    """Return the commands, and hide those not `shown` from `--help`."""
    part = copy(whole)
    part.registered_commands = [copy(each) for each in whole.registered_commands]
    for each in part.registered_commands:
        each.hidden = each.name not in shown
    return part


def main() -> None:
    sys.unraisablehook = interrupt_again
    end_like_ctrl_c()
    try:
        make_app(sys.argv[1:])(prog_name="grader", obj=True)  # in a process of its own
    except Exception:  # 1 would say that a submission has less than full marks
        traceback.print_exc()
        sys.exit(2)
