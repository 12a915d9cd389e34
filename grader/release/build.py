"""Build the release: the lab as one archive, checked for leaks of the solution.

A second folder has archives of engines to explore and of files for CI, to unpack over the lab. The
name has the version and the first digits of the content hash. The same kit makes the same archives,
byte by byte.
"""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

import msgspec
from rich.console import Console

from grader import __version__
from grader.bank.members import list_members
from grader.bank.sync import is_laid_in
from grader.bank.verify import check_kit, count_unproven
from grader.errors import Stop
from grader.judge.course import COURSE_FILE, FULL, Course
from grader.judge.fingerprint import fingerprint
from grader.judge.grade import open_tree
from grader.judge.result import Result
from grader.judge.rubric import drop_hidden
from grader.judge.task import KIT
from grader.player.replay import record_expected
from grader.release.handed_out import FOR_CI, make_students_tree, write_tree
from grader.release.leaks import find_leaks, find_secrets
from grader.release.notebooks import ENGINE, make_notebooks
from grader.release.pages import write_pages
from grader.release.project import make_project
from grader.release.recordings import Record, Recordings, record_anew
from grader.release.students_copy import Tree, write_code, write_copy
from grader.report.files import put_in
from grader.report.sinks.classroom50 import write_bundle
from grader.source.regions import python_files, read_source

NAME = "physics-engine"
MEASURING = "accuracy.ipynb"  # runs the engines to explore
UNPROVEN = (
    "The marks of {count} submissions of the bank are not proven for this version of the kit: run "
    "`make verify` once (up to an hour). The release goes on."
)
EXTRA = ("engines", "ci")  # archives to be unpacked over the lab
SECOND_ONE = "315532800"  # the same, in s


class Refused(Stop):
    """Raised to refuse a release; the message says why."""

    cannot = "release"


def release(out: Path, console: Console, fresh: bool = False, course: Course = FULL) -> list[Path]:
    """Build the release of a course into `out`; return the files and folders written.

    `verify` proves the marks of the bank once per version; `release` only counts missing results.
    `prove` checks the course's copy of the grader. Recordings and proofs are made again only if
    their sources changed, or if `fresh`.
    """
    if complaints := list(check_kit()):
        raise Refused("; ".join(complaints))
    if unproven := count_unproven(course):
        console.print(UNPROVEN.format(count=unproven))
    with tempfile.TemporaryDirectory(prefix="release-") as folder:
        work = Path(folder)
        with console.status("building the release (minutes; half a minute if nothing changed)"):
            wrong = build_wrong_members(work / "wrong", course)
            built = build(work, wrong, course, Recordings(course, fresh=fresh))
        return [move_into(each, out) for each in sorted(built.iterdir())]


def build_wrong_members(folder: Path, course: Course) -> Iterator[Tree]:
    """Build and yield a course's wrong members of the bank."""
    for member in list_members(course):
        if member.kind == "wrong" and member.form == "package" and member.replaced_todos:
            member.build(folder / member.name)
            yield folder / member.name, member.todos


def move_into(made: Path, out: Path) -> Path:
    """Move a file or folder into `out`, and replace an older one."""
    out.mkdir(parents=True, exist_ok=True)
    target = out / made.name
    if target.is_dir():
        shutil.rmtree(target)
    target.unlink(missing_ok=True)
    shutil.move(made, target)
    return target


def build(
    work: Path, wrong: Iterable[Tree], course: Course = FULL, record: Record = record_anew
) -> Path:
    """Build the release of a course below `work`, and check it; return its folder."""
    copy, tree, built = work / "copy", work / NAME, work / "built"
    built.mkdir(parents=True)
    write_copy(copy, wrong, course, record)
    write_right_runs(copy, course, record)
    folders = {"lab": tree} | {each: work / each / NAME for each in EXTRA}
    for each, files in sort_files(course).items():
        write_tree(files, folders[each])
    write_pages(KIT / "handouts", tree / "handouts", course)
    write_pages(KIT / "handouts", folders["engines"] / "handouts", course, measured=True)
    extra = [folders[each] for each in EXTRA]
    lock = strip_build_packages((KIT / "requirements.txt").read_text(encoding="utf-8"))
    content = hash_folders([copy, tree, *extra], lock)
    version = f"{__version__}+r{content[:8]}"  # pip then installs this one
    wheel = build_wheel(copy, version, tree)
    requirements = f"{lock}./{wheel.name} --hash=sha256:{sha256(wheel.read_bytes())}\n"
    (tree / "requirements.txt").write_text(requirements, encoding="utf-8", newline="\n")
    project = make_project(requirements, wheel.name)
    (tree / "pyproject.toml").write_text(project, encoding="utf-8", newline="\n")
    write_manifest(tree, version, content)
    name = f"{NAME}-{__version__}-{content[:8]}"
    write_zip(tree, built / f"{name}.zip")
    (built / f"{name}-extra").mkdir()
    for folder in extra:
        write_zip(folder, built / f"{name}-extra" / f"{folder.parent.name}.zip")
    write_bundle(built / f"{name}-classroom50", wheel, tree / "requirements.txt")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(work / "installed")
    prove_built(built, work / "installed", tree, course, record)
    return built


def prove_built(
    built: Path, package: Path, tree: Path, course: Course = FULL, record: Record = record_anew
) -> None:
    """Check the student files, unless the same bytes were checked before."""

    def check() -> bytes:
        prove(package, tree, course)
        look_for_leaks(built, course)
        return b"It marks as it must, and gives nothing away.\n"

    folders = [built, package, tree, KIT / "solution" / "notebooks"]
    record(f"proof of {hash_folders(folders, '')}", check)


def write_right_runs(copy: Path, course: Course, record: Record) -> None:
    """Write the reference's runs into a copy of the grader, for its replays."""

    def make() -> bytes:
        with open_tree(KIT / "solution") as open_child:
            return record_expected(open_child, course.rubric)

    runs = copy / "grader" / "checks" / "expected_runs.json"
    runs.write_bytes(record("runs", make))


def sort_files(course: Course) -> dict[str, dict[str, bytes]]:
    """Return the student files by archive, without pages, wheel and requirements."""
    notebooks = make_notebooks(KIT / "starter" / "notebooks", course)
    files = make_students_tree(KIT, course) | {f"notebooks/{n}": notebooks[n] for n in notebooks}
    found: dict[str, dict[str, bytes]] = {"lab": {}, "engines": {}, "ci": {}}
    for name in files.keys() - {"requirements.txt", f"notebooks/{ENGINE}"}:
        measures = is_laid_in(name) or name == f"notebooks/{MEASURING}"
        archive = "ci" if name in FOR_CI else "engines" if measures else "lab"
        found[archive][name] = files[name]
    return found


def strip_build_packages(lock: str) -> str:
    """Remove the packages that only build the grader from a lock file."""
    blocks = re.split(r"\n(?=\S)", lock.strip())
    needed = [block for block in blocks if not re.search(r"# via [^\n]*:build\)\s*$", block)]
    lines = "\n".join(needed).splitlines()
    return "".join(f"{line}\n" for line in lines if not line.lstrip().startswith("#"))


def build_wheel(copy: Path, version: str, folder: Path) -> Path:
    """Build the grader's wheel with this version in `folder`."""
    init = copy / "grader" / "__init__.py"
    text = init.read_text(encoding="utf-8")
    text = text.replace(f'"{__version__}"', f'"{version}"')
    init.write_text(text, encoding="utf-8", newline="\n")
    for name in ("pyproject.toml", "LICENSE"):
        shutil.copyfile(KIT / name, copy / name)
    for path in copy.rglob("*"):
        path.chmod(0o755 if path.is_dir() else 0o644)
    command = [sys.executable, "-m", "pip", "wheel", str(copy), "--wheel-dir", str(folder)]
    options = ["--no-deps", "--no-build-isolation", "--no-index", "--quiet"]
    same = {"SOURCE_DATE_EPOCH": SECOND_ONE, "TZ": "UTC", "LC_ALL": "C", "PYTHONUTF8": "1"}
    environment = {**os.environ, **same}
    run_command([*command, *options], folder, environment)
    (wheel,) = folder.glob("*.whl")
    return wheel


def write_manifest(tree: Path, version: str, content: str) -> None:
    head = (
        f"# {NAME} {version}\n# content {content}\n# to compare: sha256sum --check MANIFEST.txt\n"
    )
    rows = [f"{sha256(path.read_bytes())}  {name}\n" for name, path in list_files(tree)]
    (tree / "MANIFEST.txt").write_text(head + "".join(rows), encoding="utf-8", newline="\n")


def write_zip(tree: Path, target: Path, top: str = NAME) -> None:
    """Pack the files of a folder, below a folder of the name `top`."""
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, path in list_files(tree):
            put_in(archive, f"{top}/{name}", path.read_bytes())


def list_files(folder: Path) -> list[tuple[str, Path]]:
    """List the files below a folder, sorted by name."""
    found = [(p.relative_to(folder).as_posix(), p) for p in folder.rglob("*") if p.is_file()]
    return sorted(found)


def hash_folders(folders: list[Path], text: str) -> str:
    rows = [
        f"{name} {sha256(path.read_bytes())}" for each in folders for name, path in list_files(each)
    ]
    return sha256("\n".join([*rows, text]).encode("utf-8"))


def sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def prove(package: Path, tree: Path = KIT / "starter", course: Course = FULL) -> None:
    """Check that the students' copy gives the solution all points, and the starter none.

    `package` is the folder that the copy lies in.
    """
    most = drop_hidden(course.rubric).max_points
    for what, path, points in (("solution", KIT / "solution", most), ("starter", tree, 0)):
        result = grade_with(package, path)
        if (result.points, result.max_points) != (points, most):
            marks = f"{result.points} / {result.max_points} instead of {points} / {most}"
            raise Refused(f"the students' copy of the grader gives the {what} {marks}")


def prove_cut(course: Course, proven: Path = KIT / "build" / "course-check") -> None:
    """Check the students' copy for a course in seconds, without recording anything.

    A copy that passes leaves an empty file, named by its hash, in `proven` and is not graded again.
    """
    with tempfile.TemporaryDirectory(prefix="cut-") as folder:
        work = Path(folder)
        write_code(work / "copy", course)
        write_tree(make_students_tree(KIT, course), work / "tree")
        solution = "".join(map(read_source, python_files(KIT / "solution")))
        note = proven / hash_folders([work], fingerprint() + solution)
        if not note.exists():
            look_for_leaks(work, course)
            write_code(work / "whole", course, whole=True)
            prove(work / "whole", work / "tree", course)
            with suppress(OSError):  # a read-only kit
                proven.mkdir(parents=True, exist_ok=True)
                note.touch()


def grade_with(package: Path, tree: Path) -> Result:
    """Grade a submission with the grader in another folder, and with its course."""
    target = package / "result.json"
    target.unlink(missing_ok=True)
    words = ["grader", "grade", str(tree), "--json", str(target)]
    code = f"import runpy; sys.argv = {words!r}; runpy.run_module('grader', run_name='__main__')"
    students = {name: value for name, value in os.environ.items() if name != COURSE_FILE}
    said = run_command(make_command(package, code), package, students, statuses=(0, 1))
    if not target.exists():
        why = said.strip().splitlines()[-1]
        raise Refused(f"the students' copy of the grader does not run: {why}")
    return msgspec.json.decode(target.read_bytes(), type=Result)


def make_command(package: Path, code: str) -> list[str]:
    """Make a command that runs code with this copy of the grader instead of the kit's."""
    folders = [str(package), sysconfig.get_path("purelib"), sysconfig.get_path("platlib")]
    return [sys.executable, "-I", "-S", "-c", f"import sys; sys.path[:0] = {folders!r}; {code}"]


def look_for_leaks(built: Path, course: Course = FULL) -> None:
    found = list(find_leaks(built, find_secrets(KIT, course)))
    if found:
        raise Refused("\n".join(["it would give the solution away:", *map(str, found)]))


def run_command(
    command: list[str], folder: Path, environment: dict[str, str], statuses: tuple[int, ...] = (0,)
) -> str:
    """Run a command and return its output; raise Refused on another exit status."""
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, umask=0o022
    )
    if done.returncode not in statuses:
        raise Refused(f"{' '.join(command[1:4])} failed:\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr
