"""The command that turns a result into the forms of other systems."""

import os
import sys
from pathlib import Path
from typing import Annotated, Literal

import msgspec
import typer

from grader.cli.shared import stop
from grader.judge.result import Result
from grader.report.files import write_whole
from grader.report.sinks.classroom50 import NoRunner, classroom50
from grader.report.sinks.github import annotations
from grader.report.sinks.gradescope import gradescope
from grader.report.sinks.junit import junit
from grader.report.sinks.markdown import markdown
from grader.report.sinks.reporter import reporter
from grader.report.sinks.tables import csv_table, json_lines

Format = Literal[
    "classroom50", "csv", "github", "gradescope", "html", "jsonl", "junit", "markdown", "reporter"
]
TABLES = ("csv", "jsonl")  # of as many results as there are

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
    tables = format in TABLES and result.is_dir()
    if result.is_dir() and not tables:
        several = " and ".join(TABLES)
        stop(f"{result} is a folder, and {format} takes one result; {several} take many", "export")
    files = sorted(result.glob("[!.]*.json")) if tables else [result]
    if not files:
        stop(f"there are no results in {result}", "export")
    try:
        content = in_form(format, [read(file) for file in files], result.parent)
    except NoRunner as error:
        stop(str(error), "export")
    if out is None:
        sys.stdout.buffer.write(content)
    else:
        write_whole(content, out)


def read(file: Path) -> Result:
    try:
        return msgspec.json.decode(file.read_bytes(), type=Result)
    except (OSError, msgspec.MsgspecError) as error:
        stop(f"{file} is no result of the grader ({error})", "export")


def in_form(form: Format, results: list[Result], folder: Path) -> bytes:
    """The results in another form, one where it is no table; replays are in `folder`."""
    result = results[0]
    match form:
        case "csv":
            return csv_table(results)
        case "jsonl":
            return json_lines(results)
        case "classroom50":
            return classroom50(result, os.environ)
        case "github":
            return annotations(result).encode("utf-8")
        case "gradescope":
            return gradescope(result)
        case "html":
            from grader.report.html import found_replays, report  # only here: it takes its time

            return report(result, found_replays(result, folder)).encode("utf-8")
        case "junit":
            return junit(result)
        case "markdown":
            return markdown(result).encode("utf-8")
        case "reporter":
            return reporter(result)
