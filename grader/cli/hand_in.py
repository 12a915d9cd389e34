"""Pack a student's work without the given files into one zip."""

import hashlib
import io
import json
import re
import zipfile
from collections import Counter
from collections.abc import Iterator, Sequence
from datetime import datetime
from pathlib import Path

from grader.errors import Stop
from grader.judge.course import FULL, Course
from grader.judge.plain import read_plain
from grader.judge.submission import MAX_FILES, plain_files
from grader.protocol import MAX_UPLOAD
from grader.report.files import put_in, write_whole
from grader.source.flaws import find_flaw
from grader.source.regions import read_source
from grader.text import format_time, join_words, plural

PACKED = "hand-in.zip"
PROGRAMS = ("mini_engine", "pymunk_scene", "integrators")  # files without a TODO are given, too
GIVEN = {  # the other files of the folder, which no student works on
    *("Makefile", "README.md", "requirements.txt", "MANIFEST.txt", "pyproject.toml", "uv.lock"),
    *("accuracy.py", "experiments", "stable_engine", "handouts", "report"),
}
COPY = re.compile(r"(?: \(\d+\)| copy| - Copy)(?=\.\w+$)")  # as browsers and systems name them
EMPTY = ("Write your code here.", "Write your answer here.*")
DIGITS = 16  # of a hash
SUFFIXES = (".whl", ".zip")  # the grader, and earlier zips


def pack_tree(tree: Path, course: Course = FULL, out: Path | None = None) -> tuple[Path, list[str]]:
    """Pack the tree into `out` or a zip in the tree; return the zip and the names in it."""
    files = choose_files(tree, course)
    size = sum(path.stat().st_size for path in files.values())
    target = out or tree / PACKED
    if len(files) > MAX_FILES or size > MAX_UPLOAD:
        largest = max(files, key=lambda name: files[name].stat().st_size)
        if target.is_file() and not target.is_symlink():
            target.unlink()  # an older zip must not be handed in
        raise Stop(
            f"{len(files)} files of {size >> 20} MB are too many: the limit is {MAX_FILES} files "
            f"of {MAX_UPLOAD >> 20} MB. Move what does not belong to the work out of {tree}. The "
            f"largest file is {largest}, {files[largest].stat().st_size >> 20} MB"
        )
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in files:
            put_in(archive, name, read_plain(tree, name))
    write_whole(packed.getvalue(), target)
    return target, list(files)


def choose_files(tree: Path, course: Course) -> dict[str, Path]:
    """Return programs, notebooks and added files by name, in a fixed order."""
    given = {program for program in PROGRAMS if program not in course.modules}
    given |= GIVEN | {f"{program}.py" for program in given}
    found = {path.relative_to(tree).as_posix(): path for path in plain_files(tree)}
    return {
        name: found[name]
        for name in sorted(found)
        if name.partition("/")[0] not in given and not name.endswith(SUFFIXES)
    }


def list_tops(names: Sequence[str]) -> Iterator[str]:
    """Yield the packed files and folders, with the number of files in each folder."""
    for top, count in Counter(name.partition("/")[0] for name in names).items():
        yield top if top in names else f"{top}: {plural(count, 'file')}"


def list_warnings(tree: Path, names: Sequence[str]) -> Iterator[str]:
    """Yield warnings of files that a student may not want to hand in as they are."""
    for name in names:
        copy = COPY.sub("", name)
        if copy != name and copy in names:
            yield f"{name} is packed too, but only {copy} counts. Delete one of the two."
        if name.endswith(".py") and (flaw := find_flaw(read_source(tree / name))):
            yield f"{name}, line {flaw.line}: Python cannot read this ({flaw.message})."
    empty = [name for name in names if name.endswith(".ipynb") and has_no_answer(tree / name)]
    if empty:
        yield f"No answers yet in {join_words(empty)}."


def has_no_answer(path: Path) -> bool:
    """Return whether a notebook has cells to answer, all without one."""
    try:
        cells = json.loads(path.read_bytes())["cells"]
        asked = [each for each in cells if each["metadata"].get("nbgrader", {}).get("solution")]
        return bool(asked) and all("".join(c["source"]).rstrip().endswith(EMPTY) for c in asked)
    except (ValueError, KeyError, TypeError, AttributeError):  # probably no notebook
        return False


def write_receipt(packed: Path) -> str:
    """Return the time and the first digits of the zip's SHA-256."""
    digest = hashlib.sha256(packed.read_bytes()).hexdigest()[:DIGITS]
    return f"Receipt: {digest}, {format_time(datetime.now().astimezone())}"


def find_missing(names: list[str], course: Course) -> list[str]:
    here = {name.partition("/")[0].removesuffix(".py") for name in names}
    return [program for program in course.modules if program not in here]
