"""What a student hands in: the programs with the TODOs, and files of their own."""

import zipfile
from pathlib import Path

from grader.judge.course import Course
from grader.judge.submission import plain_files

PACKED = "hand-in.zip"
PROGRAMS = ("mini_engine", "pymunk_scene", "integrators")  # those without a TODO are given, too
GIVEN = {  # what the folder handed out holds besides, and nobody works on
    *("Makefile", "README.md", "requirements.txt", "MANIFEST.txt", "lab_runtime.py"),
    *("accuracy.py", "experiments", "stable_engine", "handouts"),
    *("report", PACKED),
}
SUFFIXES = (".whl", ".zip")  # the grader, and what was packed under another name
DAY_ONE = (1980, 1, 1, 0, 0, 0)  # of every file: the same work makes the same zip


def packed_files(tree: Path, course: Course) -> dict[str, Path]:
    """The files to hand in, by their names in the zip: nothing hidden, no link, nothing given."""
    given = GIVEN | {
        place_of_program(tree, each) for each in PROGRAMS if each not in course.modules
    }
    paths = {path.relative_to(tree).as_posix(): path for path in plain_files(tree)}
    return {
        name: paths[name]
        for name in sorted(paths)
        if name.partition("/")[0] not in given
        and not name.endswith(SUFFIXES)
        and not paths[name].name.startswith(".")
    }


def write_packed(files: dict[str, Path], target: Path) -> None:
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, path in files.items():
            entry = zipfile.ZipInfo(name, DAY_ONE)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, path.read_bytes())


def place_of_program(tree: Path, module: str) -> str:
    """A program as it lies in a student's folder: a package, or a file."""
    return module if (tree / module).is_dir() else f"{module}.py"
