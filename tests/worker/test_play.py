"""Test programs that are played: how they start, what they show, and the input that they get."""

import sys
from collections.abc import Callable
from contextlib import ExitStack
from itertools import pairwise
from pathlib import Path

import pytest
from one_worker import child_opener

from grader.bank.members import lay_over
from grader.checks.pacing import STEP_TAKES, frames_at, pace
from grader.judge.failures import NotYet
from grader.judge.lab import STEP, Lab
from grader.judge.task import KIT
from grader.protocol import Event, Played

LabOf = Callable[..., Lab]


@pytest.fixture
def lab_of(tmp_path: Path):
    """Make labs for programs that consist of one file."""
    with ExitStack() as stack:

        def make(text: str, module: str = "mini_engine", **files: str) -> Lab:
            folder = tmp_path / f"program{len(list(tmp_path.iterdir()))}"
            for name, each in {f"{module}.py": text, **files}.items():
                path = folder / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(each, encoding="utf-8")
            children = stack.enter_context(child_opener(folder))
            return stack.enter_context(Lab(module, lambda: children(5), []).opened())

        yield make


# ---------------------------------------------------------------- the start

PROGRAM = """
import pygame

class World:
    def step(self, dt): pass

def run(name):
    print("this is", name, "in", __name__)
    pygame.init()
    pygame.display.set_mode((50, 50))
    clock = pygame.time.Clock()
    while not pygame.event.get(pygame.QUIT):
        clock.tick(60)
        World().step(1)

def main():
    run("main")
"""


def list_starts(lab: Lab) -> list[str]:
    return [line for line in lab.play([17] * 4).lines if line.startswith("this is")]


@pytest.mark.parametrize(
    ("lines", "name"),
    {
        "": "main",
        'if __name__ == "__main__":\n    main()': "main",
        'if __name__ == "__main__":\n    name = "other"\n    run(name)': "other",
        'import sys\nif "__main__" == __name__ and sys.argv:\n    sys.exit(run("other"))': "other",
        'if __name__ != "__main__":\n    kept = 1\nelse:\n    run("other")': "other",
        'if __name__ == "__main__":\n    print("a test")': "main",
        'if __name__ == "__main__":\n    raise SystemExit("all tests passed")': "main",
        'if __name__ == "__main__":\n    input()\n    run("other")': "main",
        'if __name__ == "__main__":\n    run("other")\n    input()': "other",
        'if __name__ == "__main__":\n    import os; os.system("clear"); run("other")': "other",
        'if __name__ == "__main__":\n    import cProfile; cProfile.run("run(\'other\')")': "other",
        'if __name__ == "__main__":\n    import doctest; doctest.testmod(); run("other")': "other",
    }.items(),
)
def test_a_file_runs_what_asks_for_its_name(lines: str, name: str, lab_of: LabOf):
    assert list_starts(lab_of(PROGRAM + lines)) == [f"this is {name} in mini_engine"]


@pytest.mark.parametrize(
    ("lines", "name"),
    {
        "from mini_engine import main\nmain()": "main",
        "import cProfile\nfrom . import main\ncProfile.run('main()')": "main",
        "from . import run\n\nif __name__ == '__main__':\n    run('other')": "other",
    }.items(),
)
def test_a_package_runs_its_dunder_main(lines: str, name: str, lab_of: LabOf):
    files = {"mini_engine/__init__.py": PROGRAM, "mini_engine/__main__.py": lines}
    assert list_starts(lab_of("", **files)) == [f"this is {name} in mini_engine"]


def test_a_program_without_main_is_named(lab_of: LabOf):
    with pytest.raises(Exception, match="there is no main in mini_engine"):
        list_starts(lab_of(PROGRAM.replace("def main", "def start")))


# ---------------------------------------------------------------- the window

SHOWN = (1, 1, 2, 3, 3, 3)  # the picture of each frame
PICTURES = f"""
import pygame

def main():
    pygame.init()
    screen, clock = pygame.display.set_mode((50, 50)), pygame.time.Clock()
    pictures, running = list({SHOWN}), True
    while running:
        clock.tick(60)
        running = not pygame.event.get(pygame.QUIT)
        screen.fill("black")
        screen.set_at((40, 40), (80 * pictures.pop(0), 0, 0)) if pictures else None
        pygame.display.flip()
    pygame.quit()
"""


def test_pictures_are_equal_only_where_the_window_is(lab_of: LabOf):
    lab = lab_of(PICTURES, "pymunk_scene")
    empty, *pictures = lab.play([17] * (1 + len(SHOWN)), pictures=True).pictures
    assert empty not in pictures  # the first frame ends before anything is drawn
    assert [a == b for a, b in pairwise(pictures)] == [a == b for a, b in pairwise(SHOWN)]
    assert lab.play([17] * 3).pictures == []


# ---------------------------------------------------------------- titles and slow steps

LESSON = KIT / "tests" / "bank" / "right" / "lesson-as-printed"
START = "    clock = pygame.time.Clock()\n"
POLLS = """
    clock = pygame.time.Clock()
    while not pygame.event.get(pygame.KEYDOWN):
        clock.tick(60)
        if pygame.event.peek(pygame.QUIT):
            return
"""
WAITS = """
    pygame.display.flip()
    while (event := pygame.event.wait()).type != pygame.MOUSEBUTTONDOWN:
        if event.type == pygame.QUIT:
            return
    clock = pygame.time.Clock()
"""
SHORT_OF_TIME = """
        began = time.perf_counter()
        while accumulator >= STEP and time.perf_counter() - began < 0.002:
"""


def lesson_with(folder: Path, changes: dict[str, str]) -> Path:
    lay_over(LESSON, folder)
    program = folder / "mini_engine.py"
    text = program.read_text(encoding="utf-8")
    for old, new in changes.items():
        text = text.replace(old, new)
    program.write_text(text, encoding="utf-8")
    return folder


def play(folder: Path, changes: dict[str, str], events: list[Event]) -> Played:
    lesson_with(folder, changes)
    with (
        child_opener(folder) as children,
        Lab("mini_engine", lambda: children(5), []).opened() as lab,
    ):
        return lab.play([17] * 60, events, physics=False, trail_every=1)


@pytest.mark.parametrize("title", [POLLS, WAITS])
def test_a_title_is_opened_and_does_not_count(title: str, tmp_path: Path):
    click = [Event(20, "click", (450, 300))]
    plain = play(tmp_path / "plain", {}, click)
    titled = play(tmp_path / "titled", {START: title}, click)
    assert len(titled.steps) == len(plain.steps)
    assert abs(sum(titled.steps) - sum(plain.steps)) <= 8  # one frame, cut
    assert titled.trail[-1] == plain.trail[-1]


def test_a_program_that_never_steps_is_not_opened_for_ever(tmp_path: Path):
    played = play(tmp_path / "none", {"world.step(STEP)": "pass"}, [])
    assert played.ended == "returned" and not any(played.steps)


def test_a_loop_that_stops_when_steps_are_slow_is_behind(tmp_path: Path):
    changes = {
        "import math\n": "import math\nimport time\n",
        "        while accumulator >= STEP:\n": SHORT_OF_TIME,
    }
    frames = frames_at(60, 1.0)
    with child_opener(lesson_with(tmp_path / "short", changes)) as children:
        for takes, share in ((0.0, 1.0), (STEP_TAKES, 0.5)):
            with Lab("mini_engine", lambda: children(5), []).opened() as lab:
                steps = sum(pace(lab, frames, takes).steps)
            assert steps == pytest.approx(share / STEP, abs=3)


# ---------------------------------------------------------------- keys and buttons

INPUT = """
import pygame

class World:
    def step(self, dt): pass

def read_keys():
    keys = pygame.key.get_pressed()
    asked = bool(keys[pygame.K_LSHIFT]), bool(keys[pygame.K_RSHIFT])
    return asked, bool(pygame.key.get_mods() & pygame.KMOD_SHIFT)

def main():
    pygame.init()
    pygame.display.set_mode((50, 50))
    clock, down, running = pygame.time.Clock(), set(), True
    while running:
        clock.tick(60)
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            elif event.type == pygame.KEYDOWN:
                down.add(event.key)
            elif event.type == pygame.KEYUP:
                down.discard(event.key)
            elif event.type == pygame.MOUSEBUTTONDOWN:
                print("down", event.button, event.pos, *read_keys(), sorted(down) == [])
            elif event.type == pygame.MOUSEBUTTONUP:
                print("up", event.button, event.pos)
    print("end", *read_keys(), down)
"""


def test_a_held_key_is_down_for_the_events_of_its_frame_and_no_longer(lab_of: LabOf):
    held = ["", "left shift", "right shift", "", "left ctrl+right shift", "left ctrl"]
    clicks = [Event(n, "click", (5, 5), held=keys) for n, keys in enumerate(held, 2)]
    lines = lab_of(INPUT).play([17] * 10, clicks, physics=False).lines
    assert [line for line in lines if not line.startswith("up")] == [
        "down 1 (5, 5) (False, False) False True",
        "down 1 (5, 5) (True, False) True False",
        "down 1 (5, 5) (False, True) True False",
        "down 1 (5, 5) (False, False) False True",
        "down 1 (5, 5) (False, True) True False",
        "down 1 (5, 5) (False, False) False False",
        "end (False, False) False set()",
    ]


def test_a_click_has_its_button_and_position(lab_of: LabOf):
    events = [Event(2, "click", (5, 5)), Event(3, "click", (6, 7), button=4)]
    lines = lab_of(INPUT).play([17] * 5, events, physics=False).lines
    words = [line.partition(")")[0] for line in lines[:-1]]
    assert words == ["down 1 (5, 5", "up 1 (5, 5", "down 4 (6, 7", "up 4 (6, 7"]


# ---------------------------------------------------------------- lines that run

LINES = """
import _thread
import ctypes
import sys
from textwrap import dedent

def inner():
    return 1

class Box:
    def apart(self, n):
        for _ in range(n):
            inner()

    def together(self, n):
        for _ in range(n):
            1

    def nothing(self):
        dedent('  a library works hard here')

    def later(self, n):
        for each in range(n):
            yield each

    def stops(self):
        counter = sys.gettrace()
        sys.settrace(None)
        sys.settrace(counter)

    def ends(self):
        ctypes.pythonapi.PyEval_SetTrace(None, None)

    def hides(self):
        sys._getframe().f_trace = None

    def breaks(self):
        try:
            self.breaks()  # until the counter itself has no room left, and is taken away
        except RecursionError:
            pass

    def leaves(self):
        done = _thread.allocate_lock()
        done.acquire()
        _thread.start_new_thread(lambda: done.release(), ())
        done.acquire()

    def maps(self):
        done = _thread.allocate_lock()
        done.acquire()
        work = lambda: (sum(range(2 * 10**6)), done.release())
        list(map(_thread.start_new_thread, [work], [()]))
        done.acquire()

def make():
    return Box()
"""


def test_lines_are_counted_in_every_function(lab_of: LabOf):
    lab = lab_of(LINES)
    box = lab.thing(lab.call("make"))
    once, twice = (lab.work(box, "apart", count) for count in (10, 20))
    assert twice - once == 30  # the loop's own line, the call and the called line
    once, twice = (lab.work(box, "together", count) for count in (10, 20))
    assert twice - once == 20
    assert lab.work(box, "nothing") > 1  # the lines of a library
    assert lab.work(box, "later", 5) == 11


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux counts the seconds of a thread")
def test_a_submission_cannot_end_the_count_unnoticed(lab_of: LabOf):
    lab = lab_of(LINES)
    box = lab.thing(lab.call("make"))
    for deed, words in (
        ("stops", "sys.settrace was called"),
        ("ends", "sys.settrace was called"),
        ("hides", "its lines were hidden"),
        ("leaves", "a thread was started"),
        ("maps", "another thread worked"),
        ("breaks", "."),
    ):
        with pytest.raises(NotYet, match=words):
            lab.work(box, deed)
