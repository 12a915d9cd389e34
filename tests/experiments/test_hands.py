"""Test the window in use: mouse, buttons, engines side by side, and strips."""

import math

import pygame
import pytest
from pygame.event import Event

from experiments import scenes
from experiments.dials import drawing, strips, window
from experiments.dials.comparison import Comparison
from experiments.dials.hand import FASTEST, new_ball
from experiments.dials.show import MOST_BALLS, Show
from experiments.dials.window import FRAME
from experiments.engines import ENGINES

G = 980.0


@pytest.fixture(autouse=True)
def no_window(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setenv("SDL_AUDIODRIVER", "dummy")


@pytest.fixture
def picture():
    pygame.init()
    yield drawing.Picture()
    pygame.quit()


def run(comparison, picture, frames):
    for _ in range(frames):
        comparison.advance(FRAME)
        show, *beside = comparison.shows
        drawn = {"contacts": comparison.contacts, "strips": comparison.strips}
        picture.draw(show, timed=False, beside=beside, **drawn)


def three(scene="lab"):
    comparison = Comparison(scene, "lesson")
    comparison.put_beside()
    comparison.put_beside()
    return comparison


def mouse(kind, pos, **more):
    return Event(kind, pos=tuple(map(round, pos)), **more)


def press(pos, comparison, picture):
    window.handle(mouse(pygame.MOUSEBUTTONDOWN, pos, button=1), comparison, picture)


def move(pos, comparison, picture):
    window.handle(mouse(pygame.MOUSEMOTION, pos), comparison, picture)


def let_go(comparison, picture):
    window.handle(mouse(pygame.MOUSEBUTTONUP, (0, 0), button=1), comparison, picture)


def on_screen(side, i):
    state = side.engine.read(i)
    return side.camera.place((state.x, state.y))


def click(words, comparison, picture):
    """Press the button with this label or key."""
    key = dict(drawing.BUTTONS).get(words, words)
    place = next(place for place, each in picture.buttons if each == key)
    press(place.center, comparison, picture)


# ---------------------------------------------------------------- the mouse


def test_a_ball_is_picked_up_carried_and_thrown_in_every_engine(picture):
    comparison = three()
    run(comparison, picture, 60)
    side, i = picture.sides[1], comparison.first.engine.scene.moving()[1]
    press(on_screen(side, i), comparison, picture)
    assert comparison.hand.held == i
    goal = on_screen(side, i) + pygame.Vector2(50, -80)
    move(goal, comparison, picture)
    run(comparison, picture, 60)
    wanted = side.camera.scene_place(goal)
    for each in picture.sides:
        state = each.engine.read(i)
        assert math.dist((state.x, state.y), wanted) < 4, each.show.engine_name
    move(goal + pygame.Vector2(60, 0), comparison, picture)
    run(comparison, picture, 2)
    let_go(comparison, picture)
    for each in picture.sides:
        assert 50 < each.engine.read(i).vx <= FASTEST
    before = [each.engine.read(i).x for each in picture.sides]
    run(comparison, picture, 6)
    after = [each.engine.read(i).x for each in picture.sides]
    assert all(x > y + 10 for x, y in zip(after, before, strict=True))


def test_a_click_beside_all_balls_drops_one_into_every_engine(picture):
    comparison = three("cradle")
    run(comparison, picture, 1)
    count = len(comparison.first.engine.scene.moving())
    side = picture.sides[2]
    at = pygame.Vector2(side.view.center) - (0, 100)
    press(at, comparison, picture)
    for each in picture.sides:
        assert len(each.engine.scene.moving()) == count + 1
        state = each.engine.read(len(each.engine.scene.bodies) - 1)
        assert (state.x, state.y) == pytest.approx(side.camera.scene_place(at), abs=0.51 / 0.3)
    comparison.press(pygame.K_RETURN)
    assert len(comparison.first.engine.scene.moving()) == count, "a new start has the scene alone"


def test_there_is_an_end_to_dropping():
    show = Show("cradle", "lesson")
    for _ in range(MOST_BALLS + 3):
        show.drop(new_ball((0, -500)))
    assert len(show.engine.scene.moving()) == MOST_BALLS and "Press Enter" in show.note


def test_energy_is_counted_from_the_last_touch(picture):
    """Dragging adds energy; that is not the engine's drift."""
    comparison = Comparison("pendulum", "stable")
    run(comparison, picture, 30)
    comparison.hand.take(comparison.first.engine, comparison.first.engine.read(1)[:2])
    comparison.hand.at = (0.0, -120.0)
    run(comparison, picture, 30)
    comparison.hand.let_go()
    run(comparison, picture, 60)
    assert abs(comparison.first.figures.drift) < 5


# ---------------------------------------------------------------- contacts


@pytest.mark.parametrize("engine", ENGINES)
def test_a_resting_ball_is_held_up_by_its_weight(engine):
    """In each step its contact gives m g dt, upwards from the floor: the normal points down."""
    built = ENGINES[engine](scenes.on_floor(mass=3.0))
    for _ in range(120):
        built.step(1 / 120)
    ((x, y, nx, ny, impulse),) = built.touches()
    assert (x, y, abs(nx), abs(ny)) == pytest.approx((0, 0, 0, 1), abs=0.6)
    assert impulse is None or impulse == pytest.approx(3 * G / 120, rel=0.02)
    assert (impulse is None) == (engine == "box2d")


def test_contacts_are_drawn_when_they_are_wanted(picture):
    comparison = Comparison("tower", "stable")
    run(comparison, picture, 30)

    def touch_colored():
        shown = picture.screen.subsurface(picture.sides[0].view)
        return pygame.mask.from_threshold(shown, drawing.TOUCH, (2, 2, 2)).count()

    assert touch_colored() == 0
    comparison.press(pygame.K_x)
    run(comparison, picture, 1)
    assert touch_colored() > 100


# ---------------------------------------------------------------- side by side


def test_v_puts_engines_beside_and_in_the_end_none():
    comparison = Comparison("lab", "stable")
    seen = []
    for _ in range(4):
        seen.append([show.engine_name for show in comparison.shows])
        comparison.press(pygame.K_v)
    assert [len(each) for each in seen] == [1, 2, 3, 1]
    assert all(len(set(each)) == len(each) for each in seen)


def test_all_get_the_same_dials_and_none_is_shown_twice():
    comparison = three("pile")
    comparison.press(pygame.K_MINUS)
    comparison.press(ord("f"))
    assert {show.dt for show in comparison.shows} == {1 / 240}
    assert all("Friction" not in show.chosen for show in comparison.shows)
    comparison.press(pygame.K_3)
    names = [show.engine_name for show in comparison.shows]
    assert names[0] == "pymunk" and len(set(names)) == 3
    comparison.press(pygame.K_RIGHT)
    assert len({show.scene_name for show in comparison.shows}) == 1


def test_one_that_gives_up_does_not_stop_the_others(picture):
    comparison = three("pendulum")
    comparison.first.engine.bodies[1].vel.x = math.nan
    run(comparison, picture, 5)
    assert [show.failed for show in comparison.shows] == [True, False, False]
    assert comparison.shows[1].time > 0


# ---------------------------------------------------------------- time and dials


def test_slow_motion_runs_a_tenth_of_the_steps():
    fast, slow = Show("pendulum"), Show("pendulum")
    for _ in range(5):
        slow.press(pygame.K_COMMA)
    assert slow.rate == 0.1
    for _ in range(100):
        fast.advance(FRAME)
        slow.advance(FRAME)
    assert slow.time == pytest.approx(fast.time / 10, abs=1 / 120)
    for _ in range(5):
        slow.press(pygame.K_PERIOD)
    assert slow.rate == 1


def test_reset_puts_every_dial_back():
    show = Show("pile", "lesson")
    usual = show.passes | {}, show.substeps | {}, show.dt, show.rate, show.chosen
    for key in (pygame.K_UP, pygame.K_s, pygame.K_MINUS, pygame.K_COMMA, ord("f")):
        show.press(key)
    assert (show.passes, show.substeps, show.dt, show.rate, show.chosen) != usual
    show.press(pygame.K_0)
    assert (show.passes, show.substeps, show.dt, show.rate, show.chosen) == usual
    assert show.engine.world.iterations == show.passes["lesson"]


# ---------------------------------------------------------------- buttons


def test_every_button_does_what_its_key_does(picture):
    comparison = Comparison("lab", "lesson")
    run(comparison, picture, 3)
    click("Pause", comparison, picture)
    assert comparison.first.paused
    before = comparison.first.time
    click("One step", comparison, picture)
    assert comparison.first.time == pytest.approx(before + 1 / 120)
    click("Beside", comparison, picture)
    click("Contacts", comparison, picture)
    click("Strips", comparison, picture)
    assert len(comparison.shows) == 2 and comparison.contacts and comparison.strips
    click(pygame.K_UP, comparison, picture)
    assert comparison.first.passes["lesson"] == 16
    click(ord("f"), comparison, picture)
    assert "Friction" not in comparison.first.chosen
    click("Reset dials", comparison, picture)
    assert comparison.first.passes["lesson"] == 8
    click("Again", comparison, picture)
    assert not comparison.first.paused and comparison.first.time == 0


def test_buttons_lie_apart_and_their_words_fit(picture):
    comparison = three()
    comparison.press(pygame.K_t)
    run(comparison, picture, 2)
    places = [place for place, _ in picture.buttons]
    for number, place in enumerate(places):
        assert picture.screen.get_rect().contains(place)
        assert place.collidelist(places[number + 1 :]) < 0
    for words, key in drawing.BUTTONS:
        (place,) = (each for each, other in picture.buttons if other == key)
        assert picture.font.size(words)[0] < place.width


# ---------------------------------------------------------------- strips


def test_strips_show_what_was_measured_and_leave_room_for_the_scene(picture):
    comparison = Comparison("pendulum", "lesson")
    comparison.press(pygame.K_t)
    run(comparison, picture, 60)
    show, (side,) = comparison.first, picture.sides
    assert side.view.height == drawing.VIEW.height - strips.room_for(show)
    assert [name for name, *_ in strips.kinds(show)] == ["energy", "rod error", "overlap"]
    assert len(show.history) == 11 and show.history[-1] == (show.time, show.figures)
    box = pygame.Rect(0, 0, 80, 40)
    points = [(0.0, 1.0), (1.0, 2.0)]
    ((first, last),) = strips.curve(points, 8.0, 2.0, box)
    assert (first, last) == ((0, 20), (10, 0)), "two px of 40, and a second of eight"
    ((first, last),) = strips.curve([(0.0, -2.0), (1.0, 2.0)], 8.0, 2.0, box)
    assert (first[1], last[1]) == (40, 0)


# ---------------------------------------------------------------- the command line


def test_too_many_engines_beside_get_a_sentence(capsys):
    with pytest.raises(SystemExit):
        window.main(["--beside", "3"])
    assert "--beside is 3, but it must be 0, 1 or 2." in capsys.readouterr().err
