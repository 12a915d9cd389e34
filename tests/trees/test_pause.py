"""Test that Space pauses both lab programs, and that N then runs one step."""

import random

import pygame
import pymunk
import pytest

import lab_runtime
import pymunk_scene
from mini_engine import STEP, Window


def press(*keys):
    """Put keys into the queue of events, in turn."""
    for key in keys:
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, {"key": key}))


@pytest.fixture(autouse=True)
def no_events():
    """Empty the queue of events before and after."""
    pygame.init()
    pygame.event.clear()
    yield
    pygame.init()  # again, after a program that has ended
    pygame.event.clear()


def test_a_pause_ends_with_space_and_runs_a_step_for_each_n():
    done = []
    press(pygame.K_n, pygame.K_r, pygame.K_n, pygame.K_SPACE, pygame.K_n)
    lab_runtime.pause(lambda: done.append("step"), lambda: done.append("draw"))
    assert done == ["draw", "step", "draw", "draw", "step", "draw"]
    assert [event.key for event in pygame.event.get()] == [pygame.K_n]


def test_closing_the_window_ends_the_pause_and_the_program_hears_of_it():
    pygame.event.post(pygame.event.Event(pygame.QUIT))
    lab_runtime.pause(pytest.fail, lambda: None)
    assert [event.type for event in pygame.event.get()] == [pygame.QUIT]


def test_the_engines_window_pauses_and_goes_on():
    window, other = Window(), Window()
    pygame.event.clear()
    press(pygame.K_n, pygame.K_n, pygame.K_SPACE)
    window.press(pygame.K_SPACE)
    for _ in range(2):
        other.world.step(STEP)
    assert [body.pos for body in window.world.bodies] == [body.pos for body in other.world.bodies]
    assert "rod error: 0.0" in window.texts()[1][1]


def test_pymunks_window_pauses_and_goes_on(monkeypatch, capsys):
    shown = []
    monkeypatch.setattr(pymunk_scene, "pause", lambda one_step, draw: (one_step(), draw()))
    monkeypatch.setattr(
        pymunk_scene, "draw", lambda *seen: shown.append(seen[-1].current_time_step)
    )
    monkeypatch.setattr(lab_runtime, "frames_left", 1)
    monkeypatch.setattr(pymunk_scene, "advance", lambda *_: (0.0, 0))
    ready = pygame.init
    monkeypatch.setattr(pygame, "init", lambda: (ready(), press(pygame.K_SPACE)))
    pymunk_scene.main()
    assert shown == [STEP, STEP]  # in the pause, and in the frame that follows it
    assert "Fixed steps: 0" in capsys.readouterr().out


def test_the_rod_of_pymunk_tells_how_far_off_it_is():
    space, _ = pymunk_scene.make_space(random.Random(12))
    assert pymunk_scene.rod_error(space) == 0
    (rod,) = (each for each in space.constraints if isinstance(each, pymunk.PinJoint))
    rod.b.position += (0.25, 0)
    assert pymunk_scene.rod_error(space) == pytest.approx(0.25)
    space.remove(rod)  # as before TODO 7c
    assert pymunk_scene.rod_error(space) == 0
