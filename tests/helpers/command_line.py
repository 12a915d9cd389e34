"""Run commands of the grader in this process, as the command line runs them."""

from functools import cache

import typer
from typer.testing import CliRunner

from grader.cli.main import make_app


@cache
def all_commands() -> typer.Typer:
    return make_app()


def run_grader(*words: object, **options: object):
    """Run one command; the result has its output and exit status."""
    return CliRunner().invoke(all_commands(), [str(each) for each in words], **options)
