"""What a student hands in: one zip of their own work, without what was given to read and run."""

import zipfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from grader.judge.rubric import load_rubric
from grader.judge.submission import MAX_BYTES, MAX_FILES, CannotGrade, plain_files

NAME = "hand-in.zip"
DAY_ONE = (1980, 1, 1, 0, 0, 0)  # so that the same files are the same zip
GIVEN = {"accuracy.py", "experiments", "handouts", "stable_engine"}  # to explore, not to change
PAPERS = {"Makefile", "MANIFEST.txt", "README.md", "requirements.txt", NAME}


def hand_in(tree: Path) -> tuple[Path, list[str], list[str]]:
    """Pack the tree; returns the zip, the files in it, and the programs that are not there.

    Raises CannotGrade where there is more than will be taken in.
    """
    files = dict(own_files(tree))
    size = sum(path.stat().st_size for path in files.values())
    if len(files) > MAX_FILES or size > MAX_BYTES:
        raise CannotGrade(
            f"{len(files)} files of {size >> 20} MB are more than will be read, {MAX_FILES} files "
            f"of {MAX_BYTES >> 20} MB: move what does not belong to the work out of {tree}"
        )
    with zipfile.ZipFile(tree / NAME, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, path in files.items():
            member = zipfile.ZipInfo(name, DAY_ONE)
            member.compress_type = zipfile.ZIP_DEFLATED
            member.external_attr = 0o100644 << 16
            archive.writestr(member, path.read_bytes())
    programs = sorted({todo.module for todo in load_rubric().todos})
    here = {PurePosixPath(name).parts[0].removesuffix(".py") for name in files}
    return tree / NAME, list(files), [name for name in programs if name not in here]


def own_files(tree: Path) -> Iterator[tuple[str, Path]]:
    """Programs, notebooks and all that was added, by name, in a fixed order."""
    found = {path.relative_to(tree).as_posix(): path for path in plain_files(tree)}
    for name in sorted(found):
        first = name.partition("/")[0]
        if first not in GIVEN | PAPERS and first[0] != "." and not name.endswith(".whl"):
            yield name, found[name]
