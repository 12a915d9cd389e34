"""Make the zip with which Gradescope grades.

It holds the whole grader and the reference. Only the instructor sees it.
"""

import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path

import msgspec

from grader.classroom.gradescope.autograder import Settings
from grader.errors import Stop
from grader.judge.task import KIT
from grader.report.files import PLAIN, SCRIPT, put_in, write_whole
from grader.source.regions import python_files

HERE = Path(__file__).parent
SCRIPTS = ("setup.sh", "run_autograder")
NEWEST_FIRST = ("3.14", "3.13", "3.12", "3.11")  # the Pythons that the kit is tested on
MACHINES = ("manylinux_2_28_x86_64", "manylinux_2_17_x86_64", "manylinux2014_x86_64")


def write_autograder(path: Path, settings: Settings, wheels: str = "") -> None:
    """Write the zip; with `wheels`, a Python version, include all packages for it.

    Gradescope then downloads only that Python.
    """
    with tempfile.TemporaryDirectory() as temporary:
        work = Path(temporary)
        if wheels:
            download(wheels, work / "wheels")
        with zipfile.ZipFile(work / "autograder.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in sorted(list_files(settings, work / "wheels", wheels)):
                put_in(archive, name, content, SCRIPT if name in SCRIPTS else PLAIN)
        write_whole((work / "autograder.zip").read_bytes(), path)


def list_files(settings: Settings, wheels: Path, version: str) -> Iterator[tuple[str, bytes]]:
    """Return the files of the zip by their names; Gradescope wants scripts at its root."""
    for name in SCRIPTS:
        yield name, (HERE / name).read_bytes().replace(b"\r\n", b"\n")
    yield "pythons", f"{version or ' '.join(NEWEST_FIRST)}\n".encode()
    yield "settings.json", msgspec.json.encode(settings)
    yield "requirements.txt", (KIT / "requirements.txt").read_bytes()
    for file in sorted((KIT / "grader").rglob("*")):
        inside = file.relative_to(KIT / "grader")
        if file.is_file() and "__pycache__" not in inside.parts:
            yield f"grader/{inside.as_posix()}", file.read_bytes()
    for file in python_files(KIT / "solution"):
        yield f"solution/{file.relative_to(KIT / 'solution').as_posix()}", file.read_bytes()
    for file in wheels.glob("*.whl"):
        yield f"wheels/{file.name}", file.read_bytes()


def download(version: str, folder: Path) -> None:
    """Download everything in requirements.txt as packages for Gradescope's machines."""
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check", "download"]
    machines = [f"--platform={machine}" for machine in MACHINES]
    wanted = ["--only-binary=:all:", f"--python-version={version}", "--require-hashes"]
    files = ["-r", str(KIT / "requirements.txt"), "-d", str(folder)]
    if subprocess.run([*pip, *machines, *wanted, *files]).returncode:
        raise Stop(f"not every package could be had for Python {version}: see above")
