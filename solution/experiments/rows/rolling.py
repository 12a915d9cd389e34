"""Rows about friction: sliding, rolling, slopes, seams, and falling off an edge or a big ball."""

import math
from dataclasses import replace
from functools import partial

from ..measures import watch
from ..scenes import DT, Ball, Block, G, Scene, floor, incline, on_floor, seams
from .row import SEEN, Bound, Row, late, law, off_after, run_for


def rolls_at(trial, scene, exact, seconds=2.0):
    """Return the larger error (px/s) of the ball's speed and that of its rim."""
    i = len(scene.bodies) - 1
    state, radius = run_for(trial, scene, seconds).read(i), scene.bodies[i].radius
    return max(abs(state.vx - exact), abs(state.omega * radius - exact))


def thrown(vx, omega=0.0, mu=0.6, radius=10.0):
    """Make a ball on a floor with this friction."""
    ball = Ball((0, -radius), radius, 1.0, (vx, 0), omega, friction=mu)
    return Scene([floor(friction=mu), ball])


def uphill(degrees, fast):
    """Make a ball that rolls up a slope."""
    scene = incline(degrees)
    scene.bodies[1].vel, scene.bodies[1].omega = (-fast, 0), -fast / 10
    return scene


def hops(trial, scene):
    """Return the highest hop (px) of the ball above the floor of boxes."""
    engine, i = trial.build(scene), len(scene.bodies) - 1
    ball = scene.bodies[i]
    seconds = min(3.0, 3000 / ball.vel[0])
    return max(0.0, *watch(engine, seconds, lambda: -ball.radius - engine.read(i).y))


def on_dome(mu):
    """Make a ball at rest a little off the top of a big one, R + r = 200 px."""
    a = math.radians(5)
    dome = Ball((0, 0), 190, 0.0, friction=mu)
    return Scene([dome, Ball((200 * math.sin(a), -200 * math.cos(a)), friction=mu)])


def leaves_dome(trial, scene, exact):
    """Return the error of its speed along x after it has left, as a share."""
    engine = trial.build(scene)
    for _ in range(round(5 / DT)):
        engine.step(DT)
        state = engine.read(1)
        if math.hypot(state.x, state.y) > 205 or state.y > 0:
            break
    return abs(state.vx / exact - 1)


def off_an_edge(fast):
    """Make a ball that rolls off the edge of a table at x = 0."""
    return Scene([Block((-500, 50), (500, 50)), Ball((-50, -10), vel=(fast, 0), omega=fast / 10)])


# fmt: off
def make_rows():
    rolling = "The contact cannot change m v r + I ω: the ball ends rolling at (2 v + r ω) / 3."
    for vx, omega, mu, radius in ((300.0, 0.0, 0.6, 10.0), (300.0, 0.0, 0.3, 10.0),
                                  (300.0, 0.0, 1.0, 10.0), (100.0, 0.0, 0.6, 2.0),
                                  (600.0, 0.0, 0.6, 60.0), (200.0, -60.0, 0.6, 10.0),
                                  (0.0, 100.0, 0.6, 10.0), (100.0, 80.0, 0.3, 10.0)):
        yield Row(f"roll: from {vx:g} px/s, spin {omega:g}/s, μ {mu}, radius {radius:g}", rolling,
                  partial(thrown, vx, omega, mu, radius),
                  partial(rolls_at, exact=(2 * vx + radius * omega) / 3), law(max(vx, 200)),
                  quick=mu == 1)
    yield Row("roll: spin 10,000/s for 1 s", "While the rim slips, the ball gains μ g per second.",
              partial(on_floor, omega=1e4), partial(off_after, seconds=1, vx=0.6 * G),
              late(0.6 * G))
    yield Row("roll: on for 20 s", "Nothing slows a ball that rolls.",
              partial(thrown, 300.0, 30.0), partial(rolls_at, exact=300.0, seconds=20), law(300))
    yield Row("roll: on ice", "Without friction it slides on and does not turn.",
              partial(thrown, 300.0, 0.0, 0.0), partial(off_after, seconds=10, vx=300.0), law(300))
    for degrees in (0.1, 1.0, 10.0, 30.0, 60.0):
        a = G * math.sin(math.radians(degrees)) * 2 / 3
        yield Row(f"slope: {degrees:g}°, rolls", "A disc rolls down at ⅔ g sin θ.",
                  partial(incline, degrees), partial(rolls_at, exact=a, seconds=1), late(a),
                  quick=degrees == 30)
    for degrees, mu in ((70.0, 0.6), (45.0, 0.2), (20.0, 0.1)):
        angle = math.radians(degrees)
        a = G * (math.sin(angle) - mu * math.cos(angle))
        yield Row(f"slope: {degrees:g}°, μ {mu}, slides",
                  "Where tan θ > 3 μ a disc slides down at g (sin θ - μ cos θ).",
                  partial(incline, degrees, mu), partial(off_after, seconds=1, vx=a), late(a))
    for degrees in (5.0, 20.0):
        back = 2 * 300 / (2 / 3 * G * math.sin(math.radians(degrees)))
        yield Row(f"slope: {degrees:g}°, up and back", "Rolling loses nothing: it is back as fast.",
                  partial(uphill, degrees, 300.0),
                  partial(rolls_at, exact=300.0, seconds=round(back / DT) * DT), late(G / 2))
    for fast in (10.0, 100.0, 300.0, 1000.0, 3000.0):
        yield Row(f"seams: hops at {fast:g} px/s", "A floor of boxes side by side is flat.",
                  partial(seams, fast), hops, SEEN, quick=fast == 300)
        yield Row(f"seams: speed at {fast:g} px/s", "A flat floor does not slow what rolls.",
                  partial(seams, fast),
                  partial(rolls_at, exact=fast, seconds=min(3.0, 3000 / fast)), law(fast))
    for mu, share, words in ((0.0, 2 / 3, "slides"), (50.0, 4 / 7, "rolls")):
        c = share * math.cos(math.radians(5))
        exact = c * math.sqrt(G * 200 * c)
        yield Row(f"dome: {words} off a big ball", "By energy and Newton's law it leaves "
                  f"where the cosine is {'2/3' if mu == 0 else '4/7'} of the first one.",
                  partial(on_dome, mu), partial(leaves_dome, exact=exact),
                  Bound(0.01, "one hundredth: the start takes long, and all of it counts"),
                  quick=mu == 0)
    for fast in (200.0, 600.0):
        yield Row(f"edge: off a table at {fast:g} px/s",
                  "Where v² > g r it flies at once, and nothing changes its speed along.",
                  partial(off_an_edge, fast), partial(off_after, seconds=1, vx=fast), law(fast))
    yield Row("edge: two balls side by side roll alike", "Balls that roll alike do not push.",
              lambda: replace(thrown(200.0, 20.0), bodies=[
                  floor(), *(Ball((20.0 * i, -10), vel=(200, 0), omega=20.0) for i in range(3))]),
              partial(rolls_at, exact=200.0, seconds=5), law(200))
