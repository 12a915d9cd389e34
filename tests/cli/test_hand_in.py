"""Test that hand-in packs only the work, and that the instructor's side reads it."""

import os
import shutil
import zipfile
from hashlib import sha256
from pathlib import Path

import pytest
from command_line import run_grader

from grader.bank.sync import list_students_files
from grader.cli import hand_in as packing
from grader.cli.hand_in import PACKED, find_missing, pack_tree
from grader.cli.restore import restore
from grader.errors import Stop
from grader.intake.found import Work
from grader.intake.packing import pack
from grader.judge.course import FULL
from grader.judge.task import KIT


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """Make a student's folder with the usual other files."""
    for name, path in list_students_files(KIT).items():
        target = tmp_path / "lab" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(path.read_bytes())
    for name in ("helper.py", "data/level.json", "notebooks/quiz.ipynb", "handouts/lesson.html"):
        (tmp_path / "lab" / name).parent.mkdir(exist_ok=True)
        (tmp_path / "lab" / name).write_text("mine")
    made = (".venv/pyvenv.cfg", ".venv/lib.py", "build/replays/a.html", "pyproject.toml", "uv.lock")
    for name in (*made, "grader-1.whl", "old.zip"):
        (tmp_path / "lab" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "lab" / name).write_text("not mine")
    return tmp_path / "lab"


def test_the_zip_holds_the_work_and_nothing_else(tree):
    path, names = pack_tree(tree)
    assert not find_missing(names, FULL) and path == tree / PACKED
    wanted = {"helper.py", "data/level.json", "notebooks/quiz.ipynb", "integrators.py"}
    assert wanted < set(names) and "mini_engine/solver.py" in names
    first = {name.partition("/")[0] for name in names}
    assert first == {
        "mini_engine",
        "pymunk_scene.py",
        "integrators.py",
        "lab_runtime.py",
        "notebooks",
        "helper.py",
        "data",
    }


def test_all_packed_files_are_taken_in(tree):
    path, names = pack_tree(tree)
    package = pack(Work("ann", (path,)))
    assert [name for name, _ in package.files] == sorted(names) and not package.notes


def test_the_same_work_is_the_same_zip(tree):
    first = pack_tree(tree)[0].read_bytes()
    assert pack_tree(tree)[0].read_bytes() == first


def test_a_program_that_is_missing_is_said(tree):
    (tree / "integrators.py").unlink()
    done = run_grader("hand-in", tree / "mini_engine")
    assert done.exit_code == 1 and "There is no integrators here" in done.output
    with zipfile.ZipFile(tree / PACKED) as archive:
        assert "pymunk_scene.py" in archive.namelist()


def test_more_than_will_be_read_is_refused(tree, monkeypatch):
    monkeypatch.setattr(packing, "MAX_FILES", 3)
    (tree / PACKED).write_bytes(b"of yesterday")
    (tree / "film.dat").write_bytes(bytes(2 << 20))
    with pytest.raises(Stop, match=r"are too many: .* largest file is film\.dat, 2 MB"):
        pack_tree(tree)
    assert not (tree / PACKED).exists()


def test_hand_in_names_copies_errors_and_missing_answers(tree):
    shutil.copyfile(tree / "integrators.py", tree / "integrators (1).py")
    (tree / "helper.py").write_text("x = (", encoding="utf-8")
    for name in ("quiz", "journal"):
        notebook = KIT / "starter" / "notebooks" / f"{name}.ipynb"
        shutil.copyfile(notebook, tree / "notebooks" / notebook.name)
    text = (tree / "notebooks" / "journal.ipynb").read_text(encoding="utf-8")
    mine = text.replace("*Write your answer here.*", "One step, one moment.", 1)
    (tree / "notebooks" / "journal.ipynb").write_text(mine, encoding="utf-8")
    out = " ".join(run_grader("hand-in", tree, "--no-check").output.split())
    assert "integrators (1).py is packed too, but only integrators.py counts" in out
    assert "helper.py, line 1: Python cannot read this" in out
    assert "No answers yet in notebooks/quiz.ipynb." in out
    digest = sha256((tree / PACKED).read_bytes()).hexdigest()
    assert f"Receipt: {digest[:16]}, " in out


def test_the_checks_run_before_it_is_handed_in(tree):
    course = KIT / "tests" / "courses" / "integrators.toml"
    out = run_grader("hand-in", tree, "--course", course).output
    assert "Not finished: 8a, 8b, 8c." in " ".join(out.split())


LINKS = pytest.mark.skipif(os.name == "nt", reason="links are for administrators there")


@LINKS
def test_a_link_in_the_place_of_the_zip_is_not_written_through(tree, tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    (tree / PACKED).symlink_to(tmp_path / "mine.txt")
    path, names = pack_tree(tree)
    assert (tmp_path / "mine.txt").read_text() == "mine"
    assert not path.is_symlink() and zipfile.ZipFile(path).namelist() == names


@LINKS
@pytest.mark.parametrize("link", ["mini_engine/solver.py", "mini_engine"])
def test_given_code_is_not_put_back_through_a_link(tree, tmp_path, link):
    outside = tmp_path / "outside"
    (tree / link).rename(outside)
    (tree / link).symlink_to(outside)
    inside = outside / "solver.py" if outside.is_dir() else outside
    inside.write_text(inside.read_text().replace("def ", "def my_"))
    before = inside.read_bytes()
    with pytest.raises(Stop, match=f"{link} is a link"):
        restore(tree, "mini_engine/solver.py")
    assert inside.read_bytes() == before


@LINKS
def test_the_copy_of_what_was_put_back_is_not_written_through_a_link(tree, tmp_path):
    solver = tree / "mini_engine" / "solver.py"
    solver.write_text(solver.read_text().replace("def ", "def my_"))
    (solver.parent / "solver_old.py").symlink_to(tmp_path / "nowhere.py")
    (said,) = restore(tree, "mini_engine/solver.py")
    assert "solver_2_old.py" in said and not (tmp_path / "nowhere.py").exists()
