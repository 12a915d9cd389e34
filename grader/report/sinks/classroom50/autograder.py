"""Grade one submission for Classroom 50, whose runner starts this in the student's checkout.

It installs the grader from the files beside this one and imports nothing from the checkout. The
exit status is 0 if the submission was graded, with any marks.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ISOLATION = "auto"  # "strict" refuses to grade if files and network cannot be blocked
THE_RUNNERS = {"GITHUB_OUTPUT", "GITHUB_STEP_SUMMARY"}  # it writes the summary itself


def main() -> int:
    checkout = Path.cwd()
    with tempfile.TemporaryDirectory(prefix="classroom50-") as temporary:
        work = Path(temporary)
        os.chdir(work)  # Python must not look for modules in the checkout
        python = install(work / "python")
        if python is None:
            return 2
        return grade(python, checkout, work / "report")


def install(folder: Path) -> Path | None:
    """Install the grader; return its Python, or None if that failed."""
    venv.create(folder, with_pip=True)
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    pip = [str(python), "-I", "-m", "pip", "--quiet", "--disable-pip-version-check", "install"]
    installed = subprocess.run([*pip, "-r", "requirements.txt"], cwd=HERE).returncode == 0
    return python if installed else None


def grade(python: Path, checkout: Path, report: Path) -> int:
    """Grade, and write into the checkout the files that the runner takes."""
    grader = [str(python), "-I", "-m", "grader"]
    elsewhere = {name: os.environ[name] for name in os.environ if name not in THE_RUNNERS}
    graded = subprocess.run(
        [*grader, "grade", checkout, "--ci", report, "--isolation", ISOLATION], env=elsewhere
    ).returncode
    if graded not in (0, 1):  # full marks, or less
        return graded
    for name in ("report.html", "release-body.md", "result.json"):
        make_room(checkout / name)
    shutil.copyfile(report / "report.html", checkout / "report.html")
    shutil.copyfile(report / "summary.md", checkout / "release-body.md")
    marks = report / "result.json"
    write_status(json.loads(marks.read_bytes()))
    return subprocess.run(
        [*grader, "export", "classroom50", marks, "--out", checkout / "result.json"]
    ).returncode


def make_room(place: Path) -> None:
    """Remove a file, folder or link that the submission has under this name."""
    if place.is_dir() and not place.is_symlink():
        shutil.rmtree(place)
    else:
        place.unlink(missing_ok=True)


def write_status(result: dict[str, int]) -> None:
    """Write the status that Classroom 50 shows beside the student's commit."""
    points, most = result["points"], result["max_points"]
    status = "success" if points == most else "failure"
    if file := os.environ.get("GITHUB_OUTPUT"):
        with open(file, "a", encoding="utf-8") as output:
            output.write(f"status={status}\nsummary={points} of {most} points\n")


if __name__ == "__main__":
    sys.exit(main())
