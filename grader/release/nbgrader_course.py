"""Make the course folder of nbgrader: the assignment, and nbgrader's settings."""

import re
import shutil
import zipfile
from pathlib import Path

from grader.bank.sync import is_laid_in
from grader.classroom.nbgrader.submissions import ASSIGNMENT, NOTEBOOKS
from grader.errors import Stop
from grader.judge.course import FULL, Course
from grader.judge.task import KIT
from grader.release.handed_out import make_students_tree, write_tree
from grader.release.notebooks import make_notebooks
from grader.source.regions import regions_in

INSTRUCTOR = KIT / "handouts" / "instructor"
SHARE = re.compile(r"^(\w+) = \d+\n", re.M)  # the share of a notebook in marks.toml
SETTINGS = ("nbgrader_config.py", "marks.toml")
MANIFEST = "MANIFEST.txt"  # the manifest of a release: a hash and a name on each line


def make_course(
    course: Path, renew: bool = False, release: Path | None = None, taken: Course = FULL
) -> list[str]:
    """Make the folder in which nbgrader's commands run; return the assignment's files.

    The source holds the students' Python files with no TODO done: nbgrader releases every file
    beside the notebooks. The archive of a `release` adds the checks, so that `make check` works.
    """
    if course.resolve().is_relative_to(KIT) and not course.resolve().is_relative_to(KIT / "build"):
        raise Stop(
            f"{course} is inside the kit: nbgrader would write where solution and starter are. "
            "Name a folder outside it, or one in build."
        )
    source = course / "source" / ASSIGNMENT
    if source.exists() and not renew:
        raise Stop(
            f"there is an assignment in {source} already. --renew replaces it; "
            "settings, submissions and gradebook stay."
        )
    tree = make_students_tree(KIT, taken)
    if release is None:
        files = {name: text for name, text in tree.items() if not name.startswith(".")}
    else:
        engines = {name: text for name, text in tree.items() if is_laid_in(name)}
        files = engines | read_release(release, taken)
    files |= make_notebooks(KIT / "solution" / NOTEBOOKS, taken)
    shutil.rmtree(source, ignore_errors=True)
    write_tree(files, source)
    for name in SETTINGS:
        if not (course / name).exists():
            text = (INSTRUCTOR / name).read_text(encoding="utf-8")
            text = SHARE.sub(lambda share: share[0] if f"{share[1]}.ipynb" in files else "", text)
            (course / name).write_text(text, encoding="utf-8", newline="\n")
    return sorted(files)


def read_release(release: Path, taken: Course) -> dict[str, bytes]:
    """Read the files of an archive of `release`, except its notebooks.

    Raises Stop if it is no release, or has other TODOs.
    """
    files = {}
    try:
        with zipfile.ZipFile(release) as archive:
            for member in archive.infolist():
                _, _, name = member.filename.partition("/")
                if name and not name.startswith((".", f"{NOTEBOOKS}/")):
                    files[name] = archive.read(member)
    except OSError as error:
        raise Stop(f"there is no release at {release} ({error.strerror}): make one") from error
    except zipfile.BadZipFile as error:
        raise Stop(f"{release} is no archive of a release ({error}): make one") from error
    if MANIFEST in files:
        files[MANIFEST] = cut_manifest(files[MANIFEST], files)
    asked = {todo.id for todo in taken.rubric.todos if todo.function}
    sources = [text.decode() for name, text in files.items() if name.endswith(".py")]
    there = {region.id for text in sources for region in regions_in(text)}
    if other := sorted(there ^ asked):
        raise Stop(
            f"{release} is not of this course, they differ in TODO {', '.join(other)}: "
            "run make release for it first"
        )
    return files


def cut_manifest(manifest: bytes, files: dict[str, bytes]) -> bytes:
    """Keep the lines of a manifest that name these files."""
    rows = manifest.decode().splitlines(keepends=True)
    kept = (row for row in rows if row.startswith("#") or row.rstrip().split("  ", 1)[-1] in files)
    return "".join(kept).encode()


def find_newest_release(folder: Path) -> Path | None:
    found = sorted(folder.glob(f"{ASSIGNMENT}-*.zip"), key=lambda path: path.stat().st_mtime)
    return found[-1] if found else None
