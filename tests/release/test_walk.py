"""Do the whole lab as the lab sheet says, from the unpacked zip to full marks."""

import html
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from test_release import make

from grader.judge.rubric import drop_hidden, load_rubric
from grader.judge.task import KIT
from grader.release import build as releases
from grader.release.pages import write_pages
from grader.source.regions import regions_in, replace_regions

PYTHONS = [sys.executable, *filter(None, map(shutil.which, ("python3.13", "python3.14")))]
FRAMES = "40"  # of a program with a window
SWITCHES = ("ALL", "WATCH")  # ALL=1 with make, --all without it
LINES = 16  # of the first screen


@pytest.fixture(scope="session")
def zip_unpacked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make a release with all recordings; return its unpacked folder."""
    return make(tmp_path_factory.mktemp("released"), []).tree


@dataclass
class Student:
    """A student who types the commands of the pages in the unpacked folder."""

    tree: Path
    python: str = sys.executable
    forks: bool = True

    def types(self, line: str) -> str:
        """Run a line of a page and return its output; `python` is the folder's own.

        Its exit status is 0, or without make, after a check, also 1.
        """
        words = [self.python if word == "python" else word for word in shlex.split(line)]
        kept = {name: os.environ[name] for name in ("PATH", "HOME", "LANG") if name in os.environ}
        settings = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "COLUMNS": "80"}
        if not self.forks:
            settings["PYTHONPATH"] = str(self.tree.parent / "no fork")
        kept["PATH"] = os.pathsep.join([str(Path(self.python).parent), kept["PATH"]])  # activated
        done = subprocess.run(
            words,
            cwd=self.tree,
            env={**kept, **settings, "LAB_FRAMES": FRAMES},
            capture_output=True,
            text=True,
        )
        most = 1 if "grader check" in line else 0
        assert done.returncode <= most, f"{line}: {done.stdout}{done.stderr}"
        assert "Traceback" not in done.stderr and "***" not in done.stderr, f"{line}: {done.stderr}"
        lines = done.stdout.splitlines(keepends=True)  # on a slow machine also of the progress
        return "".join(line for line in lines if not line.startswith("Checking: "))

    def command(self, with_make: str) -> str:
        """Return a command of the sheet in its form with make or without."""
        if self.forks and shutil.which("make"):
            return with_make
        _, what, *options = with_make.split()
        flags = [option.partition("=") for option in options]
        words = (f"--{n.lower()}" + f" {v}" * (n not in SWITCHES) for n, _, v in flags)
        return " ".join(["python -m grader", what, *words])

    def writes(self, file: str, todo: str) -> None:
        """Put the right lines into a region."""
        right = (KIT / "solution" / file).read_text(encoding="utf-8")
        lines = {region.id: region.lines for region in regions_in(right) if region.id == todo}
        path = self.tree / file
        path.write_text(replace_regions(path.read_text(encoding="utf-8"), lines), encoding="utf-8")

    def changes(self, file: str, old: str, new: str) -> None:
        text = (self.tree / file).read_text(encoding="utf-8")
        assert old in text
        (self.tree / file).write_text(text.replace(old, new), encoding="utf-8")


def sheet_of(tree: Path) -> str:
    return (tree / "handouts" / "lab-sheet.html").read_text(encoding="utf-8")


def blocks(page: str) -> Iterator[list[str]]:
    """Yield the blocks of commands of a page."""
    for block in re.findall(r"<pre[^>]*><code>(.*?)</code></pre>", page, re.DOTALL):
        yield html.unescape(block).splitlines()


def tasks(page: str) -> Iterator[tuple[str, str, str]]:
    """Yield the tasks in their order: TODO, file, and the command that says PASSED."""
    for section in re.split(r'<h2 id="todo-', page)[1:]:
        said = re.search(r"<code>(make check TODO=(\w+))</code> says <code>PASSED</code>", section)
        file = re.search(r"<code>([\w/]+\.py)</code>", section)
        assert said and file, section[:100]
        yield said[2], file[1], said[1]


def environment_of(tree: Path, python: str) -> str:
    """Set up the folder as its README says; return its Python."""
    if subprocess.run([python, "-m", "venv", ".venv"], cwd=tree, capture_output=True).returncode:
        pytest.skip(f"{python} makes no environment here")
    own = tree / ".venv" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    pip = [own, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    done = subprocess.run(
        [*pip, "-r", "requirements.txt"], cwd=tree, capture_output=True, text=True
    )
    if "No matching distribution" in done.stderr or "Connection" in done.stderr:
        pytest.skip("pip reaches no package index from here")
    assert not done.returncode, done.stderr
    return str(own)


@pytest.mark.soak
@pytest.mark.parametrize("forks", [True, False], ids=["fork", "spawn"])
@pytest.mark.parametrize("python", PYTHONS, ids=[Path(each).name for each in PYTHONS])
def test_the_lab_is_walked_from_the_zip_to_full_marks(
    zip_unpacked: Path, tmp_path: Path, python: str, forks: bool
):
    tree = tmp_path / "a course" / releases.NAME
    shutil.copytree(zip_unpacked, tree)
    (tree.parent / "no fork").mkdir()
    (tree.parent / "no fork" / "sitecustomize.py").write_text("import os\ndel os.fork\n", "ascii")
    student = Student(tree, environment_of(tree, python), forks)
    page, most = sheet_of(tree), drop_hidden(load_rubric()).max_points
    programs, check = next(blocks(page)), student.command("make check")
    for line in programs:
        student.types(line)
    assert f" 0 / {most}" in student.types(check)
    guide = student.types("python -m grader")  # without a terminal it ends after its first screen
    assert "Next: TODO 8a" in guide and "Change the velocity first" in guide
    for todo, file, says in tasks(page):
        assert student.types(student.command(says)).startswith(f"NOT STARTED {todo} ")
        assert student.types(student.command(says.replace("check", "hint")))
        student.writes(file, todo)
        assert student.types(student.command(says)).startswith(f"PASSED      {todo} ")
        assert len(student.types(check).splitlines()) <= LINES
    walk_through_experiments(student, programs[0], check)
    out = student.types(check)
    assert out.startswith("PASSED") and f" {most} / {most}" in out and "To hand in" in out
    for line in programs:
        student.types(line)
    student.types(student.command("make questions"))
    assert "<details><summary>The answer" in (tree / "build/questions.html").read_text("utf-8")
    student.types(student.command("make hand-in"))
    told = [sys.executable, "-m", "grader", "grade", str(tree / "hand-in.zip"), "--at-least", "100"]
    graded = subprocess.run(told, cwd=KIT, capture_output=True, text=True)
    assert graded.returncode == 0 and "100 / 100" in graded.stdout, graded.stdout + graded.stderr


def walk_through_experiments(student: Student, program: str, check: str) -> None:
    """Change given code as the sheet says, check that it is noticed, and restore it."""
    loop, constants = "mini_engine/game_loop.py", "mini_engine/constants.py"
    student.changes(loop, "clock.tick(60)", "clock.tick(144)")
    student.changes(constants, "ITERATIONS = 8 ", "ITERATIONS = 80 ")
    student.types(program)
    assert "ITERATIONS = 80" in student.types(check)
    for name in ("ITERATIONS", loop):
        assert "as it was handed out" in student.types(
            student.command(f"make check RESTORE={name}")
        )


def test_what_is_typed_stands_in_the_sheet_in_the_order_of_the_lab(tmp_path: Path):
    """Read the commands of the walk from the page, without running them."""
    write_pages(KIT / "handouts", tmp_path / "handouts")
    page = sheet_of(tmp_path)
    found = list(tasks(page))
    assert [todo for todo, _, _ in found] == [t.id for t in load_rubric().main_todos if t.function]
    assert all(says == f"make check TODO={todo}" for todo, _, says in found)
    assert all((KIT / "starter" / file).is_file() for _, file, _ in found)
    first, *others = blocks(page)
    assert first == ["python -m mini_engine", "python pymunk_scene.py", "python integrators.py"]
    typed = [line for block in others for line in block if " # or: " in line]
    assert len(typed) >= 5
    for line in typed:  # with make, and without
        with_make, _, without = line.partition("# or: ")
        assert Student(tmp_path, forks=False).command(with_make.strip()) == without
