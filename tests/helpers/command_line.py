"""Run commands of the grader in this process, as the command line runs them."""

from typer.testing import CliRunner

from grader.cli.main import make_app


def run_grader(*words: object, **options: object):
    """Run one command; the result has its output and exit status."""
    return CliRunner().invoke(make_app(), [str(each) for each in words], **options)


def call_class(*words: object) -> str:
    """Run a command of a class; return what it says, on one line."""
    done = run_grader("class", *words)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return " ".join(done.output.split())
