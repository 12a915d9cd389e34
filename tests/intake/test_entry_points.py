"""Test all entry points: the same submission gets the same mark, or needs the same review."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import msgspec
import packed
import pytest
from command_line import run_grader
from conftest import KIT

from grader import CannotGrade, Options, grade, read_course, shipped_reference
from grader.classroom.book import read_book
from grader.classroom.gradescope import autograder

COURSE = KIT / "tests" / "courses" / "integrators.toml"  # graded in a moment
RIGHT = (KIT / "solution" / "integrators.py").read_bytes()
MOST = 40
Graded = int | str  # points, or why it needs manual review


def ask_api(path: Path, _: Path) -> Graded:
    options = Options(shipped_reference(), course=read_course(COURSE))
    try:
        return grade(path, options).points
    except CannotGrade as error:
        return str(error)


def ask_command(path: Path, work: Path, *more: str) -> Graded:
    result = work / "result.json"
    done = run_grader("grade", path, "--course", COURSE, "--json", result, *more)
    if done.exit_code == 2:
        return " ".join(done.stderr.split())
    return json.loads(result.read_bytes())["points"]


def ask_ci(path: Path, work: Path) -> Graded:
    return ask_command(path, work, "--ci", str(work / "reports"))


def ask_class(path: Path, work: Path) -> Graded:
    folder = work / "class"
    folder.mkdir()
    shutil.move(path, folder)
    run_grader("grade", "--class", folder, "--course", COURSE, "--out", work / "results")
    (outcome,) = read_book(work / "results.class.jsonl")
    return outcome.trouble or outcome.points


def ask_gradescope(path: Path, work: Path) -> Graded:
    settings = msgspec.json.encode(autograder.Settings(course=read_course(COURSE)))
    (work / "settings.json").write_bytes(settings)
    (work / "submission").mkdir()
    shutil.move(path, work / "submission")
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(autograder, "KIT", work)
        autograder.main(work)
    results = json.loads((work / "results" / "results.json").read_bytes())
    if "Not graded" in results["tests"][0]["name"]:
        return str(results["output"])
    return int(sum(test.get("score", 0) for test in results["tests"]))


ENTRIES: dict[str, Callable[[Path, Path], Graded]] = {
    "api": ask_api,
    "command": ask_command,
    "ci": ask_ci,
    "class": ask_class,
    "gradescope": ask_gradescope,
}


def hand_in(folder: Path, form: str) -> Path:
    """Write a submission in a form that students use, or that needs manual review."""
    path = folder / ("ann.zip" if form.endswith("zip") else "ann")
    if form == "zip":
        path.write_bytes(packed.as_zip({"work/integrators.py": RIGHT}))
    elif form == "two copies in a zip":
        with pytest.warns(UserWarning, match="Duplicate name"):
            path.write_bytes(packed.as_zip_of([("integrators.py", RIGHT), ("integrators.py", b"")]))
    else:
        path.mkdir()
    if form == "folder":
        (path / "a" / "b").mkdir(parents=True)
        (path / "a" / "b" / "integrators (1).py").write_bytes(RIGHT)
    elif form == "latin-1":
        (path / "integrators.py").write_bytes(RIGHT + "# Größe\n".encode("latin-1"))
    elif form == "link":
        (folder / "elsewhere.py").write_bytes(RIGHT)
        (path / "integrators.py").symlink_to(folder / "elsewhere.py")
    elif form == "zip inside":
        (path / "work.zip").write_bytes(packed.as_zip({"integrators.py": RIGHT}))
    return path


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.parametrize(
    "form",
    ["zip", *(pytest.param(each, marks=pytest.mark.soak) for each in ("folder", "zip inside"))],
)
def test_a_right_submission_has_full_marks_however_it_is_handed_in(
    entry: str, form: str, tmp_path: Path
):
    assert ENTRIES[entry](hand_in(tmp_path, form), tmp_path) == MOST


REVIEW = {
    "link": "nothing of the lab was found (integrators): it holds nothing but hidden files, links",
    "latin-1": "this line is not in UTF-8, in which Python reads files: it is needed in UTF-8",
    "two copies in a zip": "holds two different files integrators.py: one of them is needed",
}


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.parametrize("form", REVIEW)
def test_what_cannot_be_read_is_no_mark_but_for_a_person(entry: str, form: str, tmp_path: Path):
    assert REVIEW[form] in str(ENTRIES[entry](hand_in(tmp_path, form), tmp_path))
