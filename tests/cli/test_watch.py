"""Test that `check --watch` checks changed TODOs again, and shows no outdated result."""

import io
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path

import pytest
from rich.console import Console
from samples import sample

import grader.cli.watch
from grader.cli.watch import SavedAgain, Watch, list_folders, read_sources, wait_for_saves
from grader.judge.grade import grade
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT, Options
from grader.judge.wall.children import WarmWorker, start_worker
from grader.report.files import as_json
from grader.source.regions import regions_in, replace_regions

WORLD, SOLVER = "mini_engine/world.py", "mini_engine/solver.py"
INTEGRATORS = "integrators.py"
FEW = Options(reference=None, only=frozenset({"5", "8a"}))
WORTH = {todo.id: todo.max_points for todo in load_rubric().todos}
FIVE, EIGHT_A = WORTH["5"], WORTH["8a"]
BOTH = FIVE + EIGHT_A
PASSES_5, PASSES_8A = (f"TODO {todo}: 0 → {WORTH[todo]} of {WORTH[todo]}" for todo in ("5", "8a"))
LOSES_5 = f"TODO 5: {FIVE} → 0 of {FIVE}"
ONLY_8A, ONLY_5 = (f"in all {BOTH} → {WORTH[todo]} of {BOTH}" for todo in ("8a", "5"))
WHOLE = Options(reference=None)


@pytest.fixture(scope="module")
def worker() -> Iterator[WarmWorker]:
    worker = start_worker()
    yield worker
    worker.close()


class Session:
    """A watched tree, and the output since the last save."""

    def __init__(self, folder: Path, worker: WarmWorker, options: Options = FEW) -> None:
        self.folder, self.out = folder, io.StringIO()
        console = Console(file=self.out, width=80)
        self.watch = Watch(folder, options, console, worker)
        self.watch.start()

    def save(self, file: str, change: Callable[[str], str]) -> str:
        """Change a file, look, and return what is printed."""
        path = self.folder / file
        path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")
        return self.look()

    def look(self) -> str:
        self.out.seek(0)
        self.out.truncate()
        self.watch.look()
        return self.out.getvalue()

    def is_up_to_date(self) -> bool:
        """Return whether a new check gives the same result, line numbers included."""
        fresh = grade(self.folder, self.watch.options, self.watch.worker)
        return as_json(fresh) == as_json(self.watch.result)


@pytest.fixture
def open_session(hand_in, worker: WarmWorker) -> Callable[..., Session]:
    return lambda tree="starter", options=FEW: Session(hand_in(tree), worker, options)


def solved(file: str, *todos: str) -> Callable[[str], str]:
    """Return a change that puts the solution of these TODOs into a file."""
    text = (KIT / "solution" / file).read_text(encoding="utf-8")
    lines = {region.id: region.lines for region in regions_in(text) if region.id in todos}
    return lambda source: replace_regions(source, lines)


def put(old: str, new: str) -> Callable[[str], str]:
    def change(source: str) -> str:
        assert old in source
        return source.replace(old, new)

    return change


@pytest.fixture
def graded_todos(monkeypatch: pytest.MonkeyPatch) -> list[frozenset[str]]:
    """List the TODOs of each grade that a watch runs."""
    asked: list[frozenset[str]] = []

    def noting(path, options, worker):
        asked.append(options.only)
        return grade(path, options, worker)

    monkeypatch.setattr(grader.cli.watch, "grade", noting)
    return asked


# ---------------------------------------------------------------- repeated checks


def of_program(module: str) -> set[str]:
    """Return the TODOs with a check that imports this program."""
    todos = load_rubric().todos
    return {t.id for t in todos if module in {t.module, *(check.module for check in t.checks)}}


def test_a_saved_todo_comes_first_and_other_programs_not_at_all(open_session, graded_todos):
    session = open_session(options=WHOLE)
    graded_todos.clear()
    out = session.save(WORLD, solved(WORLD, "5"))
    assert graded_todos == [{"5"}, of_program("mini_engine") - {"5"}]
    assert "saved: mini_engine/world.py" in out
    assert "PASSED      5" in out and f"{PASSES_5}, in all 0 → {FIVE} of 100" in out
    assert "Next: TODO 8a" in out
    assert session.is_up_to_date()
    graded_todos.clear()
    session.save(INTEGRATORS, solved(INTEGRATORS, "8b"))
    assert graded_todos == [{"8b"}, of_program("integrators") - {"8b"}]


@pytest.mark.soak
def test_a_watch_of_one_todo_checks_no_other(open_session, graded_todos):
    session = open_session(options=Options(reference=None, only=frozenset({"8a"})))
    graded_todos.clear()
    assert f"nothing new: 0 of {EIGHT_A} points" in session.save(
        INTEGRATORS, solved(INTEGRATORS, "8b")
    )
    out = session.save(INTEGRATORS, solved(INTEGRATORS, "8a"))
    assert f"{PASSES_8A}, in all 0 → {EIGHT_A} of {EIGHT_A}" in out
    assert set().union(*graded_todos) == {"8a"}


SHARE = "keep_vel = math.exp(-self.linear_damping * dt)"
CHANGES = [
    ("starter", WORLD, put("keep_vel = 0.99", "keep_vel = 0.98"), f"0 of {FIVE} as before"),
    (
        "solution",
        WORLD,
        put(SHARE, f"raise RuntimeError\n        {SHARE}"),
        ONLY_8A,
    ),
    # Changed given code costs only the whole.
    (
        "solution",
        WORLD,
        put("self.apply_damping(dt)\n", "pass\n"),
        f"TODO 5: {FIVE} of {FIVE} as before",
    ),
    ("starter", SOLVER, lambda text: f"# mine\n{text}", f"nothing new: 0 of {BOTH} points"),
]


@pytest.mark.parametrize(("tree", "file", "change", "words"), sample(CHANGES, len(CHANGES)))
def test_each_change_is_checked_and_shown(open_session, tree, file, change, words):
    session = open_session(tree)
    assert words in session.save(file, change)
    assert session.is_up_to_date()


# ---------------------------------------------------------------- editors


def test_a_file_that_is_no_python_yet_costs_nothing(open_session, graded_todos):
    session = open_session()
    session.save(WORLD, solved(WORLD, "5"))
    graded_todos.clear()
    out = session.save(SOLVER, put("def friction_limit(c):", "def friction_limit(c:"))
    assert "mini_engine/solver.py:71 is not valid Python yet: '(' was never closed" in out
    session.save(WORLD, lambda text: text + "\n")  # while another file is broken
    assert session.watch.result.points == FIVE and not graded_todos
    out = session.save(SOLVER, put("def friction_limit(c:", "def friction_limit(c):"))
    assert f"nothing new: {FIVE} of {BOTH} points" in out
    assert session.is_up_to_date()


@pytest.mark.soak
def test_a_tree_that_was_broken_from_the_start_can_be_mended(hand_in, worker: WarmWorker):
    few = Options(reference=None, only=frozenset({"8a"}))
    session = Session(hand_in("solution", integrators_py="def (:\n"), worker, few)
    assert session.watch.result.points == 0
    text = (KIT / "solution" / INTEGRATORS).read_text(encoding="utf-8")
    assert PASSES_8A in session.save(INTEGRATORS, lambda _: text)
    assert session.is_up_to_date()


def test_a_save_during_a_check_starts_it_anew(open_session, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(grader.cli.watch, "LOOK_EVERY", 0.0)
    session, checks = open_session(), 0

    def save_again(self: Watch, check) -> None:
        nonlocal checks
        checks += 1
        if checks == 2:
            path = self.folder / WORLD
            path.write_text(solved(WORLD, "5")(path.read_text(encoding="utf-8")), encoding="utf-8")
        stop_if_saved(self, check)

    stop_if_saved = Watch.stop_if_saved
    monkeypatch.setattr(Watch, "stop_if_saved", save_again)
    out = session.save(WORLD, put("keep_vel = 0.99", "keep_vel = 0.98"))
    assert out.count("saved:") == 2 and "as before" not in out
    assert PASSES_5 in out
    assert session.is_up_to_date()


@pytest.mark.soak
def test_a_file_that_was_away_for_a_moment_is_no_reason_to_forget_the_rest(
    open_session, monkeypatch: pytest.MonkeyPatch
):
    session, stops = open_session(), iter([True])

    def stop_once(*_) -> None:
        if next(stops, False):
            raise SavedAgain

    monkeypatch.setattr(Watch, "stop_if_saved", stop_once)
    out = session.save(WORLD, solved(WORLD, "5"))
    assert out.count("saved:") == 1 and PASSES_5 in out
    assert session.is_up_to_date()


@pytest.mark.soak
def test_files_that_come_go_and_move(open_session):
    session = open_session("solution")
    moved = session.folder / "methods.py"
    (session.folder / INTEGRATORS).rename(moved)
    out = session.look()
    assert "saved: integrators.py, methods.py" in out
    assert f"TODO 8a: {EIGHT_A} → 0 of {EIGHT_A}, {ONLY_5}" in out
    assert session.is_up_to_date()
    moved.rename(session.folder / INTEGRATORS)
    assert f"in all {FIVE} → " in session.look()
    assert session.watch.result.points == BOTH and session.is_up_to_date()


@pytest.mark.soak
def test_a_given_file_that_goes_is_supplied_as_it_was_handed_out(open_session):
    session = open_session("solution")
    (session.folder / SOLVER).unlink()  # of no requested TODO
    assert session.look() == f"saved: mini_engine/solver.py\nnothing new: {BOTH} of {BOTH} points\n"
    assert session.is_up_to_date()
    (session.folder / WORLD).rename(session.folder / "mini_engine" / "worlds.py")
    assert LOSES_5 in session.look() and session.is_up_to_date()
    (session.folder / "mini_engine" / "worlds.py").rename(session.folder / WORLD)
    assert PASSES_5 in session.look()
    assert session.watch.result.points == BOTH and session.is_up_to_date()


def test_files_of_editors_are_no_saves(open_session):
    session = open_session()
    for name in (".solver.py.swp", "solver.py~", "4913", "#solver.py#", ".#solver.py"):
        (session.folder / "mini_engine" / name).write_text("half a file", encoding="utf-8")
    assert session.look() == ""


@pytest.mark.soak
def test_a_tree_that_cannot_be_copied_now_is_taken_at_the_next_save(
    open_session, monkeypatch: pytest.MonkeyPatch
):
    def raise_missing(*_):
        raise FileNotFoundError("notebooks/.tmp")

    session = open_session()
    with monkeypatch.context() as patch:
        patch.setattr(grader.cli.watch, "grade", raise_missing)
        assert "cannot read the tree now" in session.save(WORLD, solved(WORLD, "5"))
    assert PASSES_5 in session.save(SOLVER, lambda text: text + "\n")
    assert session.is_up_to_date()


# ---------------------------------------------------------------- time of a look


def test_a_virtual_environment_is_not_watched(hand_in):
    tree = hand_in("starter")
    for name in (".venv/lib", "env/lib", "build", "mini_engine/__pycache__"):
        (tree / name).mkdir(parents=True, exist_ok=True)
        (tree / name / "some.py").touch()
    (tree / "env" / "pyvenv.cfg").touch()
    watched = {folder.relative_to(tree).as_posix() for folder in list_folders(tree)}
    assert {".", "mini_engine"} <= watched
    assert not any(
        "env" in name or name in ("build", "mini_engine/__pycache__") for name in watched
    )
    assert not any("some.py" in file for file in read_sources(tree))


def test_a_watch_looks_from_time_to_time_and_ends_with_the_folder(hand_in, monkeypatch):
    monkeypatch.setattr(grader.cli.watch, "WITHOUT_EVENTS", 10)
    tree = hand_in()
    looks = wait_for_saves(tree)
    assert len(list(islice(looks, 3))) == 3
    tree.rmdir()
    assert len(list(islice(looks, 3))) < 3


@pytest.mark.parametrize(
    "replaces",
    [pytest.param(False, id="writes"), pytest.param(True, id="replaces", marks=pytest.mark.soak)],
)
@pytest.mark.skipif(os.name == "nt", reason="Ctrl-C is no signal there")
def test_a_watch_runs_until_control_c(hand_in, replaces: bool):
    tree = hand_in("starter")
    command = [sys.executable, "-m", "grader", "check", "--todo", "5", "--watch"]
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
    process = subprocess.Popen(
        command,
        cwd=tree / "mini_engine",
        env={**os.environ, "PYTHONPATH": str(KIT), "PYTHONIOENCODING": "utf-8"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )
    lines = iter(process.stdout.readline, "")
    try:
        assert any(line.startswith("Watching") for line in lines)
        text = solved(WORLD, "5")((tree / WORLD).read_text(encoding="utf-8"))
        if replaces:
            (tree / "mini_engine" / "world.tmp").write_text(text, encoding="utf-8")
            os.replace(tree / "mini_engine" / "world.tmp", tree / WORLD)
        else:
            (tree / WORLD).write_text(text, encoding="utf-8")
        assert any(line.startswith(PASSES_5) for line in lines)
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=600)
    finally:
        process.kill()
    assert process.returncode == 0 and err == ""


def test_a_terminal_shows_one_screen_and_what_changed(open_session):
    session = open_session()
    console = Console(file=session.out, width=80, force_terminal=True, color_system=None)
    session.watch.console = console
    out = session.save(WORLD, solved(WORLD, "5"))
    last = out.rpartition("\x1b[2J")[2].splitlines()
    assert "saved: mini_engine/world.py" in last[0] and len(last) <= 16
    assert f"{PASSES_5}, in all 0 → {FIVE} of {BOTH}" in last[1]
    assert any(line.startswith("PASSED      5") for line in last)
