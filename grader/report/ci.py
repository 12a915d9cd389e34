"""A result where the code of a submission lives: what a CI system keeps, and what it shows."""

import os
from collections.abc import Mapping
from pathlib import Path

import msgspec

from grader.judge.result import Result
from grader.report.files import write_json, write_whole
from grader.report.html import write_report
from grader.report.sinks.github import annotations, outputs
from grader.report.sinks.junit import junit
from grader.report.sinks.markdown import markdown

REPOSITORY = ("GITHUB_REPOSITORY", "CI_PROJECT_PATH")  # on GitHub and on GitLab: owner/name


def named_after_repository(result: Result, environment: Mapping[str, str]) -> Result:
    """The folder of a checkout may have any name; the repository has the student's."""
    path = next((environment[name] for name in REPOSITORY if environment.get(name)), "")
    name = path.rpartition("/")[2] or result.submission
    return msgspec.structs.replace(result, submission=name)


def own_folder(folder: Path) -> bool:
    """Whether reports may go there: what a submission brought along must not be among them."""
    if folder.is_symlink():
        return False
    return not folder.exists() or (folder.is_dir() and not any(folder.iterdir()))


def write_reports(result: Result, folder: Path) -> None:
    """The files that a CI system keeps of a run; replays are there already."""
    write_report(result, folder / "report.html")
    write_json(result, folder / "result.json")
    write_whole(junit(result), folder / "junit.xml")
    write_whole(markdown(result).encode("utf-8"), folder / "summary.md")


def tell_github(result: Result, path: Path, environment: Mapping[str, str]) -> None:
    """Annotations into the log, and the summary and the outputs of the step; nothing elsewhere."""
    if environment.get("GITHUB_ACTIONS") == "true":
        print(annotations(result, folder_in_repository(path, environment)), end="", flush=True)
    append(markdown(result), environment.get("GITHUB_STEP_SUMMARY"))
    append(outputs(result), environment.get("GITHUB_OUTPUT"))


def folder_in_repository(path: Path, environment: Mapping[str, str]) -> str:
    """Where the submission stands in the checkout; empty for its root, or when that is unknown."""
    folder = (path if path.is_dir() else path.parent).resolve()
    root = Path(environment.get("GITHUB_WORKSPACE") or os.curdir).resolve()
    inside = folder.relative_to(root).as_posix() if folder.is_relative_to(root) else "."
    return "" if inside == "." else inside


def append(text: str, file: str | None) -> None:
    if file:
        with open(file, "a", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
