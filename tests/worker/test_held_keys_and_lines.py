"""What the child adds for bonus tasks: keys that are held, and how many lines run."""

import sys
from pathlib import Path

import pytest
from one_worker import opened

from grader.judge.failures import NotYet
from grader.judge.lab import Lab
from grader.protocol import Event

PROGRAM = """
import pygame

class World:
    def step(self, dt): pass

def seen():
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
                print("click", *seen(), sorted(down) == [] )
    print("end", *seen(), down)
"""

BUTTONS = """
import pygame

class World:
    def step(self, dt): pass

def main():
    pygame.init()
    pygame.display.set_mode((50, 50))
    clock, running = pygame.time.Clock(), True
    words = {pygame.MOUSEBUTTONDOWN: "down", pygame.MOUSEBUTTONUP: "up"}
    while running:
        clock.tick(60)
        for event in pygame.event.get():
            running = running and event.type != pygame.QUIT
            if event.type in words:
                print(words[event.type], event.button, event.pos)
"""

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
        _thread.start_new_thread(lambda: (sum(range(10**6)), done.release()), ())
        done.acquire()

def make():
    return Box()
"""


@pytest.fixture
def lab(tmp_path: Path, request: pytest.FixtureRequest):
    (tmp_path / "program.py").write_text(request.param, encoding="utf-8")
    with opened(tmp_path) as children, Lab("program", lambda: children(5), []).opened() as lab:
        yield lab


@pytest.mark.parametrize("lab", [PROGRAM], indirect=True)
def test_a_held_key_is_down_for_the_events_of_its_frame_and_no_longer(lab: Lab):
    clicks = [
        Event(2, "click", (5, 5)),
        Event(3, "click", (5, 5), held="left shift"),
        Event(4, "click", (5, 5), held="right shift"),
        Event(5, "click", (5, 5)),
        Event(6, "click", (5, 5), held="left ctrl+right shift"),
        Event(7, "click", (5, 5), held="left ctrl"),
    ]
    played = lab.play([17] * 10, clicks, physics=False)
    assert played.lines == [
        "click (False, False) False True",
        "click (True, False) True False",
        "click (False, True) True False",
        "click (False, False) False True",
        "click (False, True) True False",
        "click (False, False) False False",
        "end (False, False) False set()",
    ]


@pytest.mark.parametrize("lab", [BUTTONS], indirect=True)
def test_a_click_is_of_the_button_it_says(lab: Lab):
    events = [Event(2, "click", (5, 5)), Event(3, "click", (6, 7), button=4)]
    played = lab.play([17] * 5, events, physics=False)
    assert played.lines == ["down 1 (5, 5)", "up 1 (5, 5)", "down 4 (6, 7)", "up 4 (6, 7)"]


@pytest.mark.parametrize("lab", [LINES], indirect=True)
def test_lines_are_counted_in_whatever_function_they_are(lab: Lab):
    box = lab.thing(lab.call("make"))
    once, twice = (lab.work(box, "apart", count) for count in (10, 20))
    assert twice - once == 30  # the loop's own line, the call and what is called
    once, twice = (lab.work(box, "together", count) for count in (10, 20))
    assert twice - once == 20
    assert lab.work(box, "nothing") > 1  # a library's lines, too
    assert lab.work(box, "later", 5) == 11


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells the seconds of a thread")
@pytest.mark.parametrize("lab", [LINES], indirect=True)
def test_who_is_counted_cannot_end_the_count_unseen(lab: Lab):
    box = lab.thing(lab.call("make"))
    for deed, told in (
        ("stops", "sys.settrace was called"),
        ("ends", "sys.settrace was called"),
        ("hides", "its lines were hidden"),
        ("leaves", "another thread worked|_thread.start_new_thread was called"),
    ):
        with pytest.raises(NotYet, match=told):
            lab.work(box, deed)
    with pytest.raises(NotYet):
        lab.work(box, "breaks")
