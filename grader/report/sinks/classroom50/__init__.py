"""Write marks for Classroom 50, and the bundle of files by which it grades."""

import shutil
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path

import msgspec

from grader.errors import Stop
from grader.judge.result import Result, TodoResult
from grader.judge.wording import add_task
from grader.text import clean

BUNDLE = Path(__file__).parent
NEEDED = {
    "classroom": "CLASSROOM",
    "assignment": "ASSIGNMENT",
    "submission": "SUBMISSION_TAG",
    "commit": "COMMIT_URL",
    "release": "RELEASE_URL",
}
STAMPED = {"assignment_type": "ASSIGNMENT_TYPE", "owner": "OWNER"}  # by the runner in any case


def write_classroom50(result: Result, environment: Mapping[str, str]) -> bytes:
    """Return its result.json: a test per TODO. The runner's environment names the student."""
    missing = [name for name in NEEDED.values() if not environment.get(name)]
    if missing:
        raise Stop(
            f"{', '.join(missing)} not set: this form is for the runner of Classroom 50, which "
            "sets them"
        )
    marks = {
        "schema": "classroom50/result/v1",
        **{field: environment[name] for field, name in NEEDED.items()},
        **{field: environment[name] for field, name in STAMPED.items() if name in environment},
        "review": environment.get("REVIEW_URL") or environment["COMMIT_URL"],
        "datetime": datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "score": result.points,
        "max-score": result.max_points,
        "tests": [make_test(todo) for todo in result.todos_to_show],
    }
    return msgspec.json.format(msgspec.json.encode(marks)) + b"\n"


def make_test(todo: TodoResult) -> dict[str, str | bool | int]:
    """Return the test of a TODO; a bonus has points in its name, so that sums are right."""
    name = add_task(todo, clean(todo.title))
    if todo.bonus:
        name += f" (bonus: {todo.points} of {todo.max_points})"
    return {
        "test-name": name,
        "passed": todo.state == "passed",
        "score": 0 if todo.bonus else todo.points,
        "max-score": 0 if todo.bonus else todo.max_points,
    }


def write_bundle(folder: Path, wheel: Path, requirements: Path) -> None:
    """Make the folder CLASSROOM/autograders/ASSIGNMENT of a Classroom 50 repository.

    `wheel` is the students' package; `requirements` names it and the packages that it needs.
    Everybody can read this folder.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for source in (BUNDLE / "autograder.py", wheel, requirements):
        shutil.copyfile(source, folder / source.name)
