"""Test `check` and `hint` from any folder, in any terminal."""

import io
import os
import re
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import pytest
from command_line import run_grader, start_grader
from rich.console import Console
from samples import sample

from grader.judge.result import CheckResult
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT, Options
from grader.judge.wording import command
from grader.report.progress import CheckProgress
from grader.report.terminal import wrap_command
from grader.source.definitions import statements
from grader.source.regions import replace_regions, shape_of

WORLD, INTEGRATORS = "mini_engine/world.py", "integrators.py"


def check(tree: Path, *todos: str, options: tuple[str, ...] = ()) -> str:
    """Return what `check` prints, without a process of its own."""
    words = ["check", str(tree), *options, *(f"--todo={todo}" for todo in todos)]
    return run_grader(*words).output


def fill_in(tree: Path, file: str, **regions: str) -> None:
    """Write lines into TODO regions of a file: `_5="..."`."""
    lines = {name[1:]: tuple(text.splitlines()) for name, text in regions.items()}
    text = (tree / file).read_text(encoding="utf-8")
    (tree / file).write_text(replace_regions(text, lines), encoding="utf-8")


# ---------------------------------------------------------------- the first minute


def test_a_fresh_tree_shows_every_todo_and_where_to_begin(hand_in):
    tree = hand_in("starter")
    done = start_grader("check", cwd=tree)
    assert done.returncode == 1 and done.stderr == "" and "\x1b" not in done.stdout
    todos = " ".join(todo.id for todo in load_rubric().main_todos)
    assert done.stdout.startswith(f"NOT STARTED {todos} ") and len(done.stdout.splitlines()) == 4
    assert "B1" not in done.stdout  # a bonus task is shown once it is started
    lines = (tree / INTEGRATORS).read_text(encoding="utf-8").splitlines()
    (marker,) = (number for number, line in enumerate(lines, 1) if "# TODO 8a:" in line)
    place = f"{INTEGRATORS}:{marker + 2}"  # the stub's return, below its comment
    assert f"Next: TODO 8a, Semi-implicit Euler ({place})" in done.stdout
    assert "python -m grader hint --todo 8a" in done.stdout


def test_all_of_it_is_a_line_for_each_todo_and_what_its_state_means(hand_in):
    out = check(hand_in("starter"), "1", "8a", options=("--all",))
    for todo in ("1", "8a"):
        assert re.search(rf"^NOT STARTED {todo} +\S.+ 0 / ", out, re.MULTILINE)
    assert "NOT STARTED only what was handed out is there" in out
    assert "To hand in: " in out


def test_outside_of_a_tree_it_says_where_to_go(tmp_path: Path):
    done = run_grader("check", tmp_path)
    assert done.exit_code == 2 and "there is no mini_engine in" in done.stderr


def test_a_check_leaves_replays_of_what_failed_and_nothing_else(hand_in, monkeypatch):
    tree = hand_in("starter")
    before = {*tree.rglob("*")}
    fill_in(tree, INTEGRATORS, _8b="    return x, v")
    monkeypatch.chdir(tree / "mini_engine")
    monkeypatch.setenv("COLUMNS", "200")
    out = check(Path(), "8b")
    to_wrap = [line for line in out.splitlines() if not line.startswith("  python ")]
    assert max(map(len, to_wrap)) <= 80
    assert re.search(r"^ {14}\S", out, re.MULTILINE)  # continuation lines are indented
    replays = re.findall(r"See it\s+(\S+)", out)
    assert replays and all(path.startswith("../build/replays/8b-") for path in replays)
    assert all((tree / "mini_engine" / path).is_file() for path in replays)
    assert {path.relative_to(tree).parts[0] for path in {*tree.rglob("*")} - before} == {"build"}
    assert (tree / "build" / "replays" / ".gitignore").read_text(encoding="utf-8") == "*\n"


@pytest.mark.skipif(
    os.name == "nt" or os.geteuid() == 0, reason="needs a folder nobody may write to"
)
def test_a_tree_that_cannot_be_written_is_checked_all_the_same(hand_in):
    tree = hand_in("starter")
    tree.chmod(0o500)
    fill_in(tree, INTEGRATORS, _8b="    return x, v")
    out = check(tree, "8b")
    tree.chmod(0o700)
    assert "NOT YET     8b" in out and "See it" not in out


@pytest.mark.parametrize(
    ("typed", "shown"),
    [
        (["python3", "-m", "grader", "check"], "python3 -m grader hint --todo 3 --level 2"),
        (
            [".venv/bin/python", "-m", "grader"],
            ".venv/bin/python -m grader hint --todo 3 --level 2",
        ),
        ([sys.executable, "-m", "grader"], "python -m grader hint --todo 3 --level 2"),
    ],
)
def test_commands_are_shown_as_they_are_typed_here(monkeypatch, typed: list[str], shown: str):
    monkeypatch.delenv("MAKELEVEL", raising=False)
    monkeypatch.setattr(sys, "orig_argv", typed)
    assert command("hint", "3", 2) == shown
    monkeypatch.setenv("MAKELEVEL", "1")
    assert command("hint", "3", 2) == "make hint TODO=3 LEVEL=2"


# ---------------------------------------------------------------- the next task


def test_waiting_says_for_what(hand_in):
    tree = hand_in("starter")
    fill_in(tree, "pymunk_scene.py", _7a="    space.gravity = 0, 980")
    out = check(tree, "whole", options=("--all",))
    assert re.search(r"^WAITING +whole", out, re.MULTILINE)
    assert "within 1 px: waiting for TODO 3, 5, 6" in " ".join(out.split())
    assert "the line below it says what" in out


# ---------------------------------------------------------------- errors


def test_an_exception_is_shown_once_with_the_students_line(hand_in):
    tree = hand_in("starter")
    fill_in(tree, WORLD, _5="        keep_vel = keep_omega = math.exq(-dt)")
    out = check(tree, "5")
    assert re.search(r"5 checks  \(0 / \d+\)", out) and out.count("AttributeError") == 1
    assert "keep_vel = keep_omega = math.exq(-dt)" in " ".join(out.split())
    assert re.search(r"Look at +mini_engine/world\.py:\d+, TODO 5", out)
    assert "Traceback" not in out and "grader/" not in out


def test_a_syntax_error_is_shown_once_and_costs_its_own_todo(hand_in):
    tree = hand_in("solution", mini_engine__joints_py="def broken(:\n")
    out = check(tree, "3", "8a")
    assert out.count("SyntaxError") == 1 and len(out.splitlines()) <= 20
    assert re.search(r"^ERROR +3", out, re.MULTILINE)
    assert "(in mini_engine/joints.py, line 1: def broken(:" in " ".join(out.split())
    assert re.search(r"^PASSED +8a", out, re.MULTILINE)


def test_a_string_that_python_warns_of_is_none_of_our_business():
    with warnings.catch_warnings(action="error"):
        assert shape_of("x = '\\d'") == shape_of("x  =  '\\d'")
        assert len(statements("x = '\\d'")) == 1


HOSTILE = "raise ValueError('\\x1b[31mπ\\r\\n\\x07' + 'ö' * 100000)"


def test_a_students_words_are_bounded_and_move_no_cursor(hand_in):
    tree = hand_in("starter")
    fill_in(tree, INTEGRATORS, _8a="    " + HOSTILE)
    out = check(tree, "8a")
    assert "ValueError" in out and len(out) < 3000
    assert not set(out) & {"\x1b", "\x07", "\r"}


@pytest.mark.soak
def test_a_terminal_that_knows_few_letters_gets_question_marks(hand_in):
    tree = hand_in("starter")
    fill_in(tree, INTEGRATORS, _8a="    " + HOSTILE)
    done = start_grader("check", "--todo", "8a", cwd=tree, PYTHONIOENCODING="ascii")
    assert done.returncode == 1 and done.stderr == ""
    assert "ValueError" in done.stdout and "????" in done.stdout


@pytest.mark.skipif(os.name == "nt", reason="Ctrl-C is no signal there")
@pytest.mark.parametrize("busy", [False, True])
def test_control_c_counts_in_the_middle_of_a_garbage_collection_too(busy: bool):
    """Python cannot raise it there, and hypothesis has a callback for each collection."""
    pressed_while_collecting = """
import gc, signal, sys, time
from grader.cli.main import interrupt_again
sys.unraisablehook = interrupt_again
signal.signal(signal.SIGINT, signal.default_int_handler)
gc.callbacks.append(lambda *_: gc.callbacks.clear() or signal.raise_signal(signal.SIGINT))
{before}gc.collect()
try:
    for _ in range(6000):  # short waits: a signal just before one would be heard after it only
        time.sleep(0.01)
except KeyboardInterrupt:
    print("heard")
"""
    # Once as usual, and once as on a busy machine, where a thread starts slowly.
    slow = """
import threading
start, slept = threading.Timer.start, []
def slowly(self):
    start(self)
    if not slept:
        slept.append(True)
        time.sleep(1)
threading.Timer.start = slowly
"""
    before = slow if busy else ""
    command = [sys.executable, "-c", pressed_while_collecting.replace("{before}", before)]
    ended = subprocess.run(command, cwd=KIT, capture_output=True, encoding="utf-8", timeout=600)
    assert (ended.stdout, ended.stderr) == ("heard\n", "")


# ---------------------------------------------------------------- the terminal


def test_lines_fit_a_narrow_terminal(hand_in):
    tree = hand_in("starter")
    fill_in(tree, INTEGRATORS, _8b="    return x, v")
    narrow = start_grader("check", "--todo", "8b", cwd=tree, COLUMNS="76").stdout
    assert "We ran" in narrow
    in_one_piece = re.compile(r"/replays/|Run it|^(A hint|All): ")  # to be copied
    words = [line for line in narrow.splitlines() if not in_one_piece.search(line)]
    assert max(map(len, words)) <= 76


def test_a_command_that_is_too_long_for_its_line_stays_in_one_piece():
    console = Console(width=80)
    assert wrap_command("    Run it    ", "python a.py", console) == ["    Run it    python a.py"]
    path = f"python build/replays/1-{'a' * 60}.py"
    assert wrap_command("    Run it    ", path, console) == ["    Run it", f"  {path}"]


def test_the_path_of_a_replay_is_in_one_piece_and_fits():
    names = [f"{todo.id}-{check.id}" for todo in load_rubric().todos for check in todo.checks]
    assert max(len(f"  build/replays/{name}.html") for name in names) <= 80


@pytest.mark.skipif(os.name == "nt", reason="a terminal is made with pty")
@pytest.mark.soak
@pytest.mark.parametrize("no_colour", ["", "1"])
def test_colour_is_for_terminals_that_want_it(hand_in, no_colour: str):
    import pty

    main, inner = pty.openpty()
    environment = {**os.environ, "PYTHONPATH": str(KIT), "TERM": "xterm-256color"}
    environment.pop("NO_COLOR", None)
    if no_colour:
        environment["NO_COLOR"] = no_colour
    command = [sys.executable, "-m", "grader", "check", "--todo", "8a"]
    subprocess.run(command, cwd=hand_in("starter"), env=environment, stdout=inner)
    os.close(inner)
    shown = os.read(main, 65536).decode()
    os.close(main)
    assert "NOT STARTED" in shown
    assert bool(re.search(r"\x1b\[(3|9)\d", shown)) is not bool(no_colour)


# ---------------------------------------------------------------- commands


@pytest.mark.parametrize(
    ("words", "todos"),
    sample(
        [
            (["8A", "2"], "2 8a"),
            (["8a"], "8a"),
            (["7"], "7a 7b 7c 7d"),
            (["--todo", "8"], "8a 8b 8c"),
        ],
        3,
    ),
)
def test_todos_are_named_by_words_alone(hand_in, words: list[str], todos: str):
    tree = hand_in("starter")
    out = run_grader("check", *words, tree / "mini_engine").output
    assert out.startswith(f"NOT STARTED {todos} "), out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("4", "1  How large may friction be"),
        ("--todo 4", "hint --todo 4 --level 2"),
        ("4 --level 3", "friction_limit(c) is the limit"),
        ("7", "7a, 7b, 7c, 7d: name one"),
        ("whole", "no hint"),
        ("", "name a TODO"),
    ],
)
def test_a_hint_is_for_one_todo_and_says_more_by_level(words: str, said: str):
    assert said in run_grader("hint", *words.split()).output


def test_printed_text_and_the_script_are_shown(hand_in):
    tree = hand_in("starter")
    code = "    print('x is', x)\n    return v, x"
    fill_in(tree, INTEGRATORS, _8a=code)
    out = check(tree, "8a")
    assert re.search(r"^    Printed   .*x is \d", out, re.MULTILINE), out
    (script,) = re.findall(r"Run it\s+\S*python\S*\s+(\S+\.py)\s", out)
    again = subprocess.run(
        [sys.executable, os.path.abspath(script)], cwd=tree, capture_output=True, encoding="utf-8"
    )
    assert again.returncode == 0 and "x is" in again.stdout, again.stderr


def test_work_beside_its_region_is_not_called_changed_given_code(hand_in):
    tree = hand_in("starter")
    text = (tree / INTEGRATORS).read_text(encoding="utf-8")
    end = "    # END TODO 8a\n"
    mine = text.replace(end, f"{end}    v += accel(x) * dt\n    return x + v * dt, v\n")
    (tree / INTEGRATORS).write_text(mine, encoding="utf-8")
    out = " ".join(check(tree).split())
    assert "stands outside the region of TODO 8a" in out and "--restore" not in out
    assert "Next: TODO 8a" in out


@pytest.mark.skipif(shutil.which("make") is None, reason="there is no make here")
def test_make_says_that_the_checks_are_not_installed(hand_in):
    tree = hand_in("starter")
    shutil.copyfile(KIT / "starter" / "Makefile", tree / "Makefile")
    python = f"{sys.executable} -S"  # without the installed packages
    done = subprocess.run(
        ["make", "check", f"PYTHON={python}"], cwd=tree, capture_output=True, encoding="utf-8"
    )
    assert done.returncode != 0 and "The checks are not installed" in done.stderr


def test_a_bar_shows_at_once_how_far_the_checks_are():
    todos = [todo for todo in load_rubric().todos if todo.id == "8a"]
    console = Console(force_terminal=True, width=80, file=io.StringIO())
    options = Options(only=frozenset({"8a"}))
    with CheckProgress(options, console) as shown:
        for check in todos[0].checks:
            shown.count(CheckResult(check.id, "A check", "unit", "passed", 1, 1))
        assert shown.counter.bar.tasks[0].completed == len(todos[0].checks)
    assert "Checking" in console.file.getvalue()
