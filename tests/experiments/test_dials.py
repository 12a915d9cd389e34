"""Test the window with dials, without opening it: frames, keys, figures and pictures."""

import itertools
import math
import os
import subprocess
import sys
from pathlib import Path

import pygame
import pytest
from samples import sample

from experiments import measures
from experiments.dials import drawing, window
from experiments.dials.show import LOOK_FOR, MEASURE_EVERY, Show
from experiments.dials.window import FRAME
from experiments.engines import ENGINES
from experiments.scenes import NAMED

KIT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def no_window(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setenv("SDL_AUDIODRIVER", "dummy")


@pytest.fixture
def picture():
    pygame.init()
    yield drawing.Picture()
    pygame.quit()


def frames(show, count):
    for _ in range(count):
        show.advance(FRAME)


def texts(show):
    return dict(drawing.figures(show))


def screenshot(folder, name, *options):
    path = folder / f"{name}.png"
    window.main(["--screenshot", str(path), "--frames", "20", *options])
    return path.read_bytes()


# ---------------------------------------------------------------- running


# `make soak` has every pair.
IN_TURNS = set(zip(NAMED, itertools.cycle(reversed(ENGINES)), strict=False))


@pytest.mark.parametrize(
    ("scene", "engine"),
    [
        pytest.param(*pair, marks=() if pair in IN_TURNS else pytest.mark.soak)
        for pair in itertools.product(NAMED, ENGINES)
    ],
)
def test_every_scene_runs_and_draws_in_every_engine(scene, engine, picture):
    show = Show(scene, engine)
    picture.draw(show)
    view = picture.screen.subsurface(drawing.VIEW.inflate(-4, -4))
    assert len(set(view.get_buffer().raw)) > 10, "nothing in view"
    frames(show, 30)
    picture.draw(show)
    assert not show.failed
    assert show.time == pytest.approx(0.5)
    assert show.note == "" or "without" in show.note


@pytest.mark.parametrize("scene", NAMED)
def test_the_camera_shows_all_balls_at_the_start(scene):
    data = NAMED[scene]()
    camera = drawing.Camera(data)
    for i in data.moving():
        ball = data.bodies[i]
        radius = ball.radius * camera.scale
        disc = pygame.Rect(
            camera.place(ball.pos) - pygame.Vector2(radius), (2 * radius, 2 * radius)
        )
        assert drawing.VIEW.contains(disc)
        assert radius >= 2


@pytest.mark.parametrize("scene", sample(NAMED, 3))
def test_no_text_is_cut_off(scene, picture):
    """All texts of the panel fit beside the scene and above the help lines."""
    for engine in ENGINES:
        show = Show(scene, engine)
        for note in ("A body has a number that is NaN or infinite.", show.note):
            show.note = note
            assert picture.draw_panel(show, timed=True) <= drawing.VIEW.bottom
    texts_of = [text for lines in (drawing.dials(show), drawing.figures(show)) for _, text in lines]
    room = drawing.PANEL - drawing.VALUES
    assert all(picture.font.size(text)[0] < room for text in texts_of)


def test_every_scene_says_what_to_look_for():
    assert LOOK_FOR.keys() == NAMED.keys()


def test_a_slow_frame_owes_no_more_than_the_cap():
    show = Show("pendulum")
    show.advance(10.0)
    assert show.time == pytest.approx(8 / 120)


def test_the_window_ends_when_closed_and_when_the_budget_is_spent(monkeypatch):
    shown = []
    monkeypatch.setattr(drawing.Picture, "draw", lambda *_, **__: shown.append(1))
    monkeypatch.setattr(window, "frame_budget", lambda: len(shown) < 7)
    window.main(["--scene", "cradle"])
    assert len(shown) == 7
    monkeypatch.setattr(window, "frame_budget", lambda: True)
    closing = [[], [pygame.event.Event(pygame.QUIT)]]
    monkeypatch.setattr(pygame.event, "get", lambda: closing.pop(0))
    window.main(["--scene", "cradle"])
    assert closing == []


def test_keys_reach_the_show_through_the_event_queue(monkeypatch):
    def key(key, mod=0):
        return pygame.event.Event(pygame.KEYDOWN, key=key, mod=mod)

    script = [[key(pygame.K_1)], [key(pygame.K_UP), key(pygame.K_s)], [key(pygame.K_ESCAPE)]]
    seen = []
    monkeypatch.setattr(pygame.event, "get", lambda: script.pop(0))
    monkeypatch.setattr(drawing.Picture, "draw", lambda _, show, **__: seen.append(show))
    window.main(["--scene", "cradle"])
    show = seen[-1]
    assert (show.engine_name, show.engine.world.iterations) == ("lesson", 16)
    assert show.engine.substeps == 2


# ---------------------------------------------------------------- dials


def press(show, *keys, shift=False):
    for key in keys:
        show.press(key, shift)


def test_tab_and_numbers_choose_the_engine():
    show = Show("lab", "lesson")
    names = []
    for key in (pygame.K_TAB, pygame.K_TAB, pygame.K_TAB, pygame.K_3, pygame.K_2, pygame.K_1):
        press(show, key)
        names.append(show.engine.name)
    assert names[:3] == [*ENGINES, "lesson"][1:4]
    assert names[3:] == ["pymunk", "stable", "lesson"]


def test_a_key_for_an_engine_that_is_not_installed_says_so(monkeypatch):
    show = Show("lab", "stable")
    monkeypatch.delitem(ENGINES, "box2d", raising=False)
    press(show, pygame.K_4)
    assert show.engine.name == "stable"
    assert "pip install Box2D" in show.note


def test_arrows_choose_the_scene_and_go_round():
    show, names = Show("lab"), list(NAMED)
    press(show, pygame.K_RIGHT)
    assert show.scene_name == names[1]
    press(show, pygame.K_LEFT, pygame.K_LEFT)
    assert show.scene_name == names[-1]


def test_dials_turn_without_moving_a_body():
    for engine in ENGINES:
        show = Show("pile", engine)
        frames(show, 10)
        before, running = measures.states(show.engine), show.engine
        press(show, pygame.K_UP, pygame.K_RIGHTBRACKET, pygame.K_EQUALS, pygame.K_MINUS, pygame.K_s)
        assert show.engine is running
        assert measures.states(show.engine) == before
        assert show.time > 0


def test_passes_reach_the_engines():
    show = Show("tower", "lesson")
    press(show, pygame.K_UP, pygame.K_UP)
    assert show.engine.world.iterations == 32
    press(show, *[pygame.K_DOWN] * 9)
    assert show.engine.world.iterations == 1
    press(show, pygame.K_3, pygame.K_UP)
    assert show.engine.space.iterations == 20
    press(show, pygame.K_2, pygame.K_UP)
    assert "no passes" in show.note


def test_the_step_goes_from_a_30th_to_a_480th():
    show = Show("pendulum")
    press(show, *[pygame.K_EQUALS] * 9)
    assert show.dt == 1 / 30
    press(show, *[pygame.K_MINUS] * 9)
    assert show.dt == 1 / 480
    show.advance(FRAME)
    assert show.time == pytest.approx(FRAME)


def test_space_pauses_n_steps_and_enter_starts_again():
    show = Show("pendulum")
    frames(show, 10)
    press(show, pygame.K_SPACE)
    before = show.time
    frames(show, 10)
    assert show.time == before
    press(show, pygame.K_n)
    assert show.time == pytest.approx(before + show.dt)
    press(show, pygame.K_RETURN)
    assert show.time == 0
    assert not show.paused


@pytest.mark.parametrize(
    ("scene", "key", "effect"),
    [
        ("pile", "c", "Contacts"),
        ("pile", "f", "Friction"),
        ("lab", "b", "Bounce"),
        ("pendulum", "r", "Rods"),
        ("spring", "g", "Springs"),
        ("lab", "d", "Damping"),
        ("bullet", "u", "Bullets"),
        ("pile", "z", "Sleep"),
    ],
)
def test_letters_declare_an_effect_and_take_it_back(scene, key, effect):
    show = Show(scene, "stable")
    was_on = effect in show.engine.world.effects
    press(show, ord(key))
    assert (effect in show.engine.world.effects) is not was_on
    assert show.time == 0
    assert "starts again" in show.note
    press(show, ord(key))
    assert (effect in show.engine.world.effects) is was_on


@pytest.mark.parametrize("engine", ENGINES)
def test_an_effect_that_the_scene_calls_for_is_missed_whatever_the_engine(engine):
    show = Show("pile", engine)
    assert "calls for" not in show.note
    press(show, ord("f"))
    assert "starts again." in show.note
    assert "This scene calls for Friction(), which it does not" in show.note
    press(show, ord("f"))
    assert "calls for" not in show.note


def test_a_letter_that_would_change_nothing_says_why():
    show = Show("tower", "lesson")
    for key, words in (("z", "no sleep"), ("c", "always"), ("r", "nothing in this scene")):
        running = show.engine
        press(show, ord(key))
        assert words in show.note
        assert show.engine is running
    show = Show("pendulum")
    press(show, pygame.K_b)
    assert "needs contacts" in show.note


# ---------------------------------------------------------------- figures


def test_the_figures_are_those_of_the_measures():
    for engine in ENGINES:
        show = Show("box", engine)
        frames(show, 2 * MEASURE_EVERY)
        text = texts(show)
        assert text["rod error"] == f"{measures.worst_stretch(show.engine):.3f} px"
        assert text["overlap"] == f"{measures.deepest_overlap(show.engine):.3f} px"
        assert text["contacts"] == str(show.engine.contacts())


def test_sleepers_are_counted_and_drawn_grey(picture):
    show = Show("tower", "stable")
    press(show, pygame.K_z)
    frames(show, 400)
    assert texts(show)["asleep"] == "20 of 20"
    assert {picture.color(show.engine, i) for i in show.engine.scene.moving()} == {drawing.ASLEEP}
    picture.draw(show)
    place = picture.camera.place(show.engine.read(5)[:2]) + pygame.Vector2(0, 4)
    assert picture.screen.get_at(tuple(map(round, place)))[:3] == drawing.ASLEEP


def test_an_engine_that_gives_up_says_why(picture):
    show = Show("pendulum", "lesson")
    frames(show, 5)
    show.engine.bodies[1].vel.x = math.nan
    frames(show, 5)
    assert show.paused
    assert "Body.vel.x is nan" in show.note
    picture.draw(show)
    show = Show("pendulum", "pymunk")
    show.engine.bodies[1].velocity = (1e300, 1e300)
    frames(show, 5)
    assert "gave up" in show.note
    picture.draw(show)


# ---------------------------------------------------------------- command line


def test_a_screenshot_is_the_same_each_time(tmp_path):
    options = ("--scene", "pile", "--engine", "stable")
    once, again = (screenshot(tmp_path, name, *options) for name in ("a", "b"))
    assert once == again
    assert screenshot(tmp_path, "c", "--scene", "pile", "--engine", "lesson") != once


@pytest.mark.parametrize(("option", "right"), [("--scene", NAMED), ("--engine", ENGINES)])
def test_a_wrong_name_gets_a_sentence_with_the_right_ones(option, right, capsys):
    with pytest.raises(SystemExit):
        window.main([option, "no-such"])
    said = capsys.readouterr().err
    assert f"'no-such' is none of: {', '.join(right)}." in said


def run_in(tree, picture, engine, **environment):
    """Return the screenshot that the window's program makes, started in a folder."""
    program = [sys.executable, "-m", "experiments.dials", "--scene", "lab", "--engine", engine]
    program += ["--screenshot", str(picture), "--frames", "60"]
    env = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **environment}
    subprocess.run(program, cwd=tree, env=env, check=True, timeout=600)
    return picture.read_bytes()


@pytest.mark.parametrize(
    "engine", ["lesson", *(pytest.param(each, marks=pytest.mark.soak) for each in [*ENGINES][1:])]
)
def test_it_runs_in_a_students_folder_with_nothing_done(engine, handed_out, tmp_path):
    assert len(run_in(handed_out, tmp_path / "shot.png", engine)) > 1000


@pytest.mark.soak
def test_make_dials_shows_the_starters_engine_though_the_window_is_the_solutions(
    handed_out, tmp_path
):
    assert "cd $(WHERE) && PYTHONPATH=../solution" in (KIT / "Makefile").read_text("utf-8")
    shots = [
        run_in(KIT / tree, tmp_path / f"{tree}.png", "lesson", PYTHONPATH="../solution")
        for tree in ("starter", "solution")
    ]
    assert shots[0] == run_in(handed_out, tmp_path / "shot.png", "lesson") != shots[1]
