"""Pack what a student hands in: one zip of their own work, without what was given."""

import io
import zipfile
from pathlib import Path

from grader.errors import Stop
from grader.judge.course import FULL, Course
from grader.judge.plain import read_plain
from grader.judge.submission import MAX_BYTES, MAX_FILES, plain_files
from grader.report.files import put_in, write_whole

PACKED = "hand-in.zip"
PROGRAMS = ("mini_engine", "pymunk_scene", "integrators")  # those without a TODO are given, too
GIVEN = {  # what the folder handed out holds besides, and nobody works on
    *("Makefile", "README.md", "requirements.txt", "MANIFEST.txt"),
    *("accuracy.py", "experiments", "stable_engine", "handouts", "report"),
}
SUFFIXES = (".whl", ".zip")  # the grader, and what was packed before


def pack_tree(tree: Path, course: Course = FULL, out: Path | None = None) -> tuple[Path, list[str]]:
    """Pack the tree; return the zip, `out` or else in the tree, and the names in it."""
    files = choose_files(tree, course)
    size = sum(path.stat().st_size for path in files.values())
    if len(files) > MAX_FILES or size > MAX_BYTES:
        raise Stop(
            f"{len(files)} files of {size >> 20} MB are more than will be read, {MAX_FILES} files "
            f"of {MAX_BYTES >> 20} MB: move what does not belong to the work out of {tree}"
        )
    target = out or tree / PACKED
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in files:
            put_in(archive, name, read_plain(tree, name))
    write_whole(packed.getvalue(), target)
    return target, list(files)


def choose_files(tree: Path, course: Course) -> dict[str, Path]:
    """Return programs, notebooks and all that was added, by name, in a fixed order."""
    given = {program for program in PROGRAMS if program not in course.modules}
    given |= GIVEN | {f"{program}.py" for program in given}
    found = {path.relative_to(tree).as_posix(): path for path in plain_files(tree)}
    return {
        name: found[name]
        for name in sorted(found)
        if name.partition("/")[0] not in given and not name.endswith(SUFFIXES)
    }


def find_missing(names: list[str], course: Course) -> list[str]:
    here = {name.partition("/")[0].removesuffix(".py") for name in names}
    return [program for program in course.modules if program not in here]
