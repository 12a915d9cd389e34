"""Test `python -m grader` alone: the next task on the screen, and keys for help."""

import io
import os
import select
import sys
from collections.abc import Callable, Iterator
from types import SimpleNamespace

import pytest
from page_readers import barriers, chromium
from rich.console import Console
from test_watch import FEW, INTEGRATORS, put, solved

import grader.cli.guide
from grader.cli.guide import Guide, Quit, Running
from grader.cli.keys import read_key, read_windows_key
from grader.cli.student import load_hints
from grader.judge.course import FULL
from grader.judge.task import KIT, Options
from grader.judge.wall.children import WarmWorker, start_worker
from grader.release.handouts import make_handouts, make_tasks

TASKS = {"5": ["Make them lose a rate per second."], "8a": ["Change the velocity first."]}
STUB = "    return explicit_euler(x, v, dt, accel)\n    # END TODO 8a"
ONE = Options(reference=None, only=frozenset({"8a"}), trusted=True)


@pytest.fixture(scope="module")
def worker() -> Iterator[WarmWorker]:
    worker = start_worker()
    yield worker
    worker.close()


@pytest.fixture
def opened_pages(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """List the pages opened in a browser."""
    pages: list[str] = []
    monkeypatch.setattr(grader.cli.guide.webbrowser, "open", pages.append)
    return pages


@pytest.fixture
def open_guide(hand_in, worker: WarmWorker) -> Callable[..., Guide]:
    """Return a function that starts a guide and shows its first screen."""

    def start(tree: str = "starter", options: Options = ONE) -> Guide:
        folder = hand_in(tree)
        replays = folder / "build" / "replays"
        replays.mkdir(parents=True)
        console = Console(file=io.StringIO(), width=80)
        guide = Guide(folder, options, console, worker, replays, tasks=TASKS)
        guide.start()
        return guide

    return start


def read_output(guide: Guide) -> str:
    """Return the output since the last call, on one line."""
    out = guide.console.file
    text = out.getvalue()
    out.seek(0)
    out.truncate()
    return " ".join(text.split())


def save(guide: Guide, change: Callable[[str], str]) -> str:
    path = guide.folder / INTEGRATORS
    path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")
    read_output(guide)
    guide.look()
    return read_output(guide)


def press(guide: Guide, key: str) -> str:
    read_output(guide)
    guide.press(key)
    return read_output(guide)


def test_the_first_screen_has_the_next_task_with_its_text_and_the_keys(open_guide):
    text = read_output(open_guide(options=FEW))
    assert "Next: TODO 8a, Semi-implicit Euler" in text  # the lab sheet begins with it
    assert TASKS["8a"][0] in text and text.endswith(grader.cli.guide.KEYS.replace("   ", " "))
    assert "hint --todo" not in text and "check --todo" not in text


def test_each_save_shows_the_failure_or_the_next_task(open_guide):
    guide = open_guide(options=FEW)
    text = save(
        guide,
        put(STUB, "    return v, x\n    # END TODO 8a"),
    )
    assert "NOT YET 8a" in text and "Meaning" in text and "q quit" in text
    text = save(guide, solved(INTEGRATORS, "8a"))
    assert "PASSED 8a" in text and "Next: TODO 5" in text and TASKS["5"][0] in text


def test_hints_come_one_by_one_and_the_last_one_stays(open_guide):
    guide, hints = open_guide(), load_hints("8a")
    for number in (1, 2, 3, 3):
        text = press(guide, "h")
        assert f"Hint {number} of 3: {' '.join(hints[number - 1].split())}" in text
        assert ("next hint" in text) == (number < 3)


def test_a_failure_has_a_replay_and_what_was_printed(open_guide, opened_pages: list[str]):
    guide = open_guide()
    assert "no replay" in press(guide, "r") and "printed nothing" in press(guide, "p")
    save(guide, put(STUB, "    print('here it is')\n    return x, v\n    # END TODO 8a"))
    assert "here it is" in press(guide, "p")
    assert "Opening" in press(guide, "r")
    (page,) = opened_pages
    assert page.startswith("file:") and "/8a-" in page and not press(guide, "x")


def test_a_program_runs_beside_the_guide_and_its_last_words_are_shown(open_guide):
    guide = open_guide()
    assert "Started python integrators.py" in press(guide, "w")
    assert "is running" in press(guide, "w")
    guide.running.process.wait()
    guide.show_output()
    assert "semi_implicit_euler 39151.23" in read_output(guide) and guide.running is None
    guide.show_output()
    assert read_output(guide) == ""


def test_a_package_is_started_as_a_module_in_the_folder_of_the_student(open_guide, monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setenv("LAB_FRAMES", "5")
    running = Running.start(open_guide().folder, "mini_engine")
    assert running.name == "python -m mini_engine" and running.process.wait() == 0
    assert any(line.startswith("Fixed steps: ") for line in running.read_output())


def test_q_ends_it(open_guide):
    with pytest.raises(Quit):
        open_guide().press("q")


def test_at_full_marks_there_are_the_film_the_bonus_tasks_and_the_questions(
    open_guide, opened_pages: list[str], monkeypatch: pytest.MonkeyPatch
):
    guide = open_guide("solution", Options(reference=None, only=frozenset({"8a", "B6"})))
    path = guide.folder / "mini_engine" / "bonus" / "window.py"
    stub = (KIT / "starter" / "mini_engine" / "bonus" / "window.py").read_text(encoding="utf-8")
    path.write_text(stub, encoding="utf-8")
    read_output(guide)
    guide.look()
    text = read_output(guide)
    assert "All checks pass. To hand in:" in text
    assert grader.cli.guide.KEYS_AT_THE_END.replace("   ", " ") in text
    assert "Next: TODO B6" in press(guide, "b")
    assert "Hint 1 of 3" in press(guide, "h")
    assert "no cases for practice" in press(guide, "t")  # the kit has none
    monkeypatch.setattr(grader.cli.practice, "make_questions", make_page)
    press(guide, "t")
    assert opened_pages[0].endswith("questions.html")


def make_page(folder, course):
    return SimpleNamespace(questions=("one",)), folder / "questions.html"


def test_before_full_marks_these_keys_do_nothing(open_guide):
    guide = open_guide()
    assert not any(press(guide, key) for key in "fbt")


def test_the_film_is_of_the_students_own_engine(open_guide, opened_pages: list[str]):
    guide = open_guide("solution", Options(reference=None, only=frozenset({"1", "8a"})))
    press(guide, "f")
    page = (guide.folder / "build" / "film.html").read_text(encoding="utf-8")
    assert opened_pages[0].endswith("film.html") and "<svg" in page and "Your engine" in page
    world = guide.folder / "mini_engine" / "world.py"
    world.write_text("raise SystemExit\n", encoding="utf-8")
    assert "There is no film" in press(guide, "f")


@pytest.mark.soak
def test_everybody_can_use_the_page_of_the_film(open_guide, opened_pages: list[str]):
    guide = open_guide("solution")
    press(guide, "f")
    with chromium() as browser:
        assert barriers(browser, guide.folder / "build" / "film.html") == []


# ---------------------------------------------------------------- texts and keys


def test_each_todo_has_a_text_in_plain_words():
    tasks = make_tasks(make_handouts(KIT / "handouts", FULL))
    assert set(tasks) == {todo.id for todo in FULL.rubric.todos if todo.function}
    for paragraphs in tasks.values():
        assert paragraphs and not any(set("*`[") & set(words) for words in paragraphs)
        assert sum(map(len, paragraphs)) < 800


@pytest.mark.skipif(os.name == "nt", reason="a Windows terminal has no pseudo-terminal")
def test_a_letter_is_read_without_enter_and_an_arrow_is_no_letter():
    import pty
    import tty

    controller, terminal = pty.openpty()
    tty.setcbreak(terminal)
    try:
        assert read_key(terminal) == ""
        for typed, letter in ((b"h", "h"), (b"Q", "q"), (b"\x1b[A", "")):
            os.write(controller, typed)
            select.select([terminal], [], [])  # until the letters are there
            assert read_key(terminal) == letter
    finally:
        os.close(controller)
        os.close(terminal)


def test_windows_keys_that_come_in_two_parts_are_no_letters(monkeypatch: pytest.MonkeyPatch):
    typed = list("h\xe0HR")
    fake = SimpleNamespace(kbhit=lambda: bool(typed), getwch=lambda: typed.pop(0))
    monkeypatch.setitem(sys.modules, "msvcrt", fake)
    assert [read_windows_key() for _ in range(4)] == ["h", "", "r", ""]
