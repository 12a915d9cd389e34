"""Write the files of a result for a CI system, and annotations beside the code."""

import os
from collections.abc import Mapping
from pathlib import Path

import msgspec

from grader.judge.result import Result
from grader.report.files import write_json, write_whole
from grader.report.html import write_report
from grader.report.sinks.github import write_annotations, write_outputs
from grader.report.sinks.junit import write_junit
from grader.report.sinks.markdown import write_markdown

REPOSITORY = ("GITHUB_REPOSITORY", "CI_PROJECT_PATH")  # on GitHub and on GitLab: owner/name


def name_after_repository(result: Result, environment: Mapping[str, str]) -> Result:
    """Name a result after the repository: a checkout's folder may have any name."""
    path = next((environment[name] for name in REPOSITORY if environment.get(name)), "")
    name = path.rpartition("/")[2] or result.submission
    return msgspec.structs.replace(result, submission=name)


def is_free_folder(folder: Path) -> bool:
    """Return whether a folder is new or empty, so that a submission has no files in it."""
    if folder.is_symlink():
        return False
    return not folder.exists() or (folder.is_dir() and not any(folder.iterdir()))


def write_reports(result: Result, folder: Path) -> None:
    """Write the files of a run for a CI system, except the replays."""
    write_report(result, folder / "report.html")
    write_json(result, folder / "result.json")
    write_whole(write_junit(result), folder / "junit.xml")
    write_whole(write_markdown(result).encode("utf-8"), folder / "summary.md")


def tell_github(result: Result, path: Path, environment: Mapping[str, str]) -> None:
    """Print annotations if on GitHub; write the step's summary and outputs."""
    if environment.get("GITHUB_ACTIONS") == "true":
        folder = locate_in_repository(path, environment)
        print(write_annotations(result, folder), end="", flush=True)
    append(write_markdown(result), environment.get("GITHUB_STEP_SUMMARY"))
    append(write_outputs(result), environment.get("GITHUB_OUTPUT"))


def locate_in_repository(path: Path, environment: Mapping[str, str]) -> str:
    """Return the submission's folder in the checkout; empty for its root or an unknown one."""
    folder = (path if path.is_dir() else path.parent).resolve()
    root = Path(environment.get("GITHUB_WORKSPACE") or os.curdir).resolve()
    inside = folder.relative_to(root).as_posix() if folder.is_relative_to(root) else "."
    return "" if inside == "." else inside


def append(text: str, file: str | None) -> None:
    if file:
        with open(file, "a", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
