"""Define the command that turns a result into the forms of other systems."""

import os
import sys
from pathlib import Path
from typing import Annotated, Literal

import typer

from grader.cli.shared import require_file_target
from grader.errors import Stop
from grader.judge.result import Result
from grader.report.files import read_result, write_whole
from grader.report.sinks.classroom50 import write_classroom50
from grader.report.sinks.github import write_annotations
from grader.report.sinks.gradescope import write_gradescope
from grader.report.sinks.junit import write_junit
from grader.report.sinks.markdown import write_markdown
from grader.report.sinks.reporter import write_reporter
from grader.report.sinks.tables import write_csv, write_json_lines

Format = Literal[
    "classroom50", "csv", "github", "gradescope", "html", "jsonl", "junit", "markdown", "reporter"
]
TABLES = ("csv", "jsonl")  # for any number of results

app = typer.Typer()


@app.command("export")
def export_command(
    format: Annotated[Format, typer.Argument(help="The form to write.")],
    result: Annotated[
        Path,
        typer.Argument(help="A result, as `grade --json` writes it; for tables also a folder."),
    ],
    out: Annotated[Path | None, typer.Option(help="Write this file instead of printing.")] = None,
) -> None:
    """Turn a result into a form that another system reads."""
    require_file_target(out, "--out")
    tables = format in TABLES and result.is_dir()
    if result.is_dir() and not tables:
        several = " and ".join(TABLES)
        raise Stop(f"{result} is a folder, and {format} takes one result; {several} take many")
    files = sorted(result.glob("[!.]*.json")) if tables else [result]
    if not files:
        raise Stop(f"there are no results in {result}")
    content = write_form(format, [read_result(file) for file in files], result.parent)
    if out is None:
        sys.stdout.buffer.write(content)
    else:
        write_whole(content, out)


def write_form(form: Format, results: list[Result], folder: Path) -> bytes:
    """Return the results in another form; only tables take several. Replays are in `folder`."""
    result = results[0]
    match form:
        case "csv":
            return write_csv(results)
        case "jsonl":
            return write_json_lines(results)
        case "classroom50":
            return write_classroom50(result, os.environ)
        case "github":
            return write_annotations(result).encode("utf-8")
        case "gradescope":
            return write_gradescope(result)
        case "html":
            from grader.report.html import find_replays, render  # imported here, since it is slow

            return render(result, find_replays(result, folder)).encode("utf-8")
        case "junit":
            return write_junit(result)
        case "markdown":
            return write_markdown(result).encode("utf-8")
        case "reporter":
            return write_reporter(result)
