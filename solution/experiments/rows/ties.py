"""Rows about rods and springs: closed forms, energy, and references by TINY steps."""

import math
from functools import partial
from itertools import accumulate

import numpy as np

from ..measures import energy, states, stretches, watch, worst_stretch
from ..reference import reference
from ..scenes import DT, Ball, G, Scene, Spring, chain, oscillator, pendulum, pendulum_period
from .hits import moment_lost
from .row import CLOCK, ENERGY, SEEN, Bound, Row, late, law, run_for, share_off, velocity_off_after

RODS = ("Rods",)
TINY = "Newton's law, solved by the method of Runge and Kutta in steps of 1/960 s."
KEPT = "Rods do no work: energy is kept."
RIGID = "Rods keep their length."
KNOWN = {}  # references, by scene and time
PUSH = {"needs": ("rods that push",)}


def energy_off(trial, scene, seconds, scale, each=4):
    """Return the largest change of the energy, as a share of scale (kg px²/s²)."""
    engine = trial.build(scene)
    start, worst = energy(engine), 0.0
    for i in range(round(seconds / DT)):
        engine.step(DT)
        if i % each == 0:
            worst = max(worst, abs(energy(engine) - start))
    return worst / scale


def ever_stretches(trial, scene, seconds):
    """Return the largest error (px) of any rod's length."""
    engine = trial.build(scene)
    return max(watch(engine, seconds, lambda: worst_stretch(engine)))


def hangs(trial, scene, seconds=10):
    """Return the sum (px) of all rods' errors of length in the end."""
    return sum(stretches(run_for(trial, scene, seconds)))


def period_off(trial, scene, exact, seconds=20):
    """Return the error of the mean period, as a share."""
    engine, x, passages = trial.build(scene), scene.bodies[1].pos[0], []
    for i in range(round(seconds / DT)):
        engine.step(DT)
        before, x = x, engine.read(1).x
        if x <= 0 < before:
            passages.append((i + before / (before - x)) * DT)
    if len(passages) < 2:
        return math.inf
    return share_off((passages[-1] - passages[0]) / (len(passages) - 1), exact)


def stays(trial, scene, seconds=5):
    """Return the largest distance (px) of any body from its start in the end."""
    engine = run_for(trial, scene, seconds)
    return max(math.dist(s[:2], b.pos) for s, b in zip(states(engine), scene.bodies, strict=True))


def centre_off(trial, scene, seconds=1):
    """Return the distance (px) of free balls' centre of mass from its parabola."""
    masses = [b.mass for b in scene.bodies]

    def centre(vectors):
        return np.average([vector[:2] for vector in vectors], axis=0, weights=masses)

    drift = centre([b.vel for b in scene.bodies]) + np.array(scene.gravity) * seconds / 2
    exact = centre([b.pos for b in scene.bodies]) + drift * seconds
    return math.dist(centre(states(run_for(trial, scene, seconds))), exact)


def follows(trial, scene, seconds):
    """Return the largest distance (px) of any body from the reference by TINY steps."""
    key, engine, worst = (repr(scene), seconds), trial.build(scene), 0.0
    if key not in KNOWN:
        KNOWN[key] = list(reference(scene, seconds))
    for now in KNOWN[key]:
        engine.step(DT)
        places = np.array([state[:2] for state in states(engine)])
        worst = max(worst, float(np.hypot(*(places - now).T).max()))
    return worst


# ---------------------------------------------------------------- scenes


def double(mass=1.0, degrees=90.0):
    """Make a double pendulum of two rods of 100 px, let go at an angle."""
    a = math.radians(degrees)
    way = math.sin(a), math.cos(a)
    balls = [Ball((100 * k * way[0], 100 * k * way[1]), mass=m) for k, m in ((1, mass), (2, 1.0))]
    return Scene([Ball((0, 0), mass=0), *balls], RODS, [(0, 1), (1, 2)])


def looping(share=1.1):
    """Make a pendulum at its lowest position, with more speed than a full circle takes."""
    bob = Ball((0, 140), vel=(share * math.sqrt(5 * G * 140), 0))
    return Scene([Ball((0, 0), mass=0), bob], RODS, [(0, 1)])


def tumbling(fast, mass=1.0, gravity=(0.0, 0.0), drift=(0.0, 0.0)):
    """Make two balls on a rod of 50 px that turns about its centre of mass."""
    share = 1 / (1 + mass)
    ends = [
        Ball((-50 * mass * share, 0), 5, vel=(drift[0], drift[1] - 2 * mass * share * fast)),
        Ball((50 * share, 0), 5, mass, vel=(drift[0], drift[1] + 2 * share * fast)),
    ]
    return Scene(ends, RODS, [(0, 1)], gravity=gravity)


def ring(count, fast):
    """Make a ring of balls on rods that turns about its middle."""
    balls = []
    for i in range(count):
        a = 2 * math.pi * i / count
        vel = -fast * math.sin(a), fast * math.cos(a)
        balls.append(Ball((100 * math.cos(a), 100 * math.sin(a)), 5, vel=vel))
    rods = [(i, (i + 1) % count) for i in range(count)]
    return Scene(balls, RODS, rods, gravity=(0, 0))


def bridge(links, weight):
    """Make a hanging bridge in its exact shape: tan θ grows by weight from rod to rod."""
    places = [(0.0, 0.0)]
    for i in range(links):
        (x, y), slope = places[-1], weight * ((links - 1) / 2 - i)
        length = math.hypot(1, slope)
        places.append((x + 30 / length, y + 30 * slope / length))
    bodies = [Ball(place, 5, float(0 < i < links)) for i, place in enumerate(places)]
    return Scene(bodies, RODS, [(i, i + 1) for i in range(links)])


def roof(mass):
    """Make a weight that two rods hold up between two static feet."""
    feet = [Ball((x, 0), mass=0) for x in (-60, 60)]
    return Scene([*feet, Ball((0, -80), mass=mass)], RODS, [(0, 2), (1, 2)])


def struck(degrees):
    """Make a ball that strikes one end of a rod, at an angle to it; e = 1, no friction."""
    a, ideal = math.radians(degrees), {"restitution": 1.0, "friction": 0.0}
    way = math.cos(a), math.sin(a)
    ball = Ball((-100 * way[0], -100 * way[1]), vel=(300 * way[0], 300 * way[1]), **ideal)
    ends = [Ball((0, 0), **ideal), Ball((60, 0), **ideal)]
    return Scene([ball, *ends], ("Contacts", "Bounce", "Rods"), [(1, 2)], gravity=(0, 0))


def struck_exact(degrees):
    """Return the ball's velocity (px/s) just after the hit."""
    a = math.radians(degrees)
    inverse = math.cos(a) ** 2 / 2 + math.sin(a) ** 2  # 1/kg, of the end along the hit
    fast = 300 * (1 - 2 / (1 + inverse))
    return fast * math.cos(a), fast * math.sin(a)


def spring_chain(count, stiffness, damping, at_rest):
    """Make balls that hang on springs of 20 px from a peg, at rest or not yet stretched."""
    lengths = [20 + (count - i) * G / stiffness * at_rest for i in range(count)]
    places = enumerate(accumulate(lengths, initial=0.0))
    bodies = [Ball((0, y), 4, float(i > 0)) for i, y in places]
    springs = [Spring(i, i + 1, stiffness, damping, 20.0) for i in range(count)]
    return Scene(bodies, ("Springs",), springs=springs)


def hangs_low(trial, scene, seconds=20):
    """Return the error of the stretch of a chain of springs, as a share."""
    count = len(scene.springs)
    stretch = run_for(trial, scene, seconds).read(count).y - 20 * count
    return share_off(stretch, count * (count + 1) / 2 * G / scene.springs[0].stiffness)


def swing_off(trial, scene, seconds=20, ever=False):
    """Return how much the swing of the last two seconds differs from the first, as a share.

    With `ever`, tell how much larger any swing is.
    """
    engine = trial.build(scene)
    lengths = watch(engine, seconds, lambda: abs(engine.read(1).x - 100))
    if ever:
        return max(0.0, max(lengths) / 50 - 1)
    return abs(max(lengths[-round(2 / DT) :]) / 50 - 1)


def ellipse(fast):
    """Make a ball on a spring without length: it goes around the peg on an ellipse."""
    bodies = [Ball((0, 0), mass=0), Ball((150, 0), vel=(0, fast))]
    return Scene(bodies, ("Springs",), springs=[Spring(0, 1, 40.0)], gravity=(0, 0))


def loose_pair(mass, turn=0.0):
    """Make two free balls on a stretched spring."""
    balls = [Ball((0, 0), vel=(0, -turn * mass)), Ball((150, 0), mass=mass, vel=(0, turn))]
    return Scene(balls, ("Springs",), springs=[Spring(0, 1, 400.0, length=100)], gravity=(0, 0))


def mode(number, count=5, stiffness=400.0):
    """Make balls on springs between two pegs, pulled along into one of their modes."""
    xs = [50.0 * i for i in range(count + 2)]
    for i in range(1, count + 1):
        xs[i] += 10 * math.sin(math.pi * number * i / (count + 1))
    bodies = [Ball((x, 0), 5, float(0 < i <= count)) for i, x in enumerate(xs)]
    springs = [Spring(i, i + 1, stiffness, length=50.0) for i in range(count + 1)]
    return Scene(bodies, ("Springs",), springs=springs, gravity=(0, 0))


# fmt: off
def make_pendulum_rows():
    for degrees in (10, 90, 170):
        scene = partial(pendulum, 140.0, degrees)
        yield Row(f"pendulum: from {degrees}°, period",
                  "2π √(l/g) divided by the arithmetic-geometric mean of 1 and cos(θ/2).",
                  scene, partial(period_off, exact=pendulum_period(140.0, degrees)), CLOCK,
                  quick=degrees == 90)
        height = 6 * G * 140 * (1 - math.cos(math.radians(degrees)))
        yield Row(f"pendulum: from {degrees}°, energy for 20 s", KEPT, scene,
                  partial(energy_off, seconds=20, scale=height), ENERGY, quick=degrees == 90)
        yield Row(f"pendulum: from {degrees}°, path for 3 s", TINY, scene,
                  partial(follows, seconds=3), late(math.sqrt(2 * height / 6)))
        yield Row(f"pendulum: from {degrees}°, length", RIGID, scene,
                  partial(ever_stretches, seconds=5), SEEN)
    yield Row("pendulum: full circles for 20 s, energy", KEPT, looping,
              partial(energy_off, seconds=20, scale=0.5 * 1.21 * 5 * G * 140), ENERGY)
    yield Row("pendulum: full circles for 3 s, path", TINY, looping, partial(follows, seconds=3),
              late(1.1 * math.sqrt(5 * G * 140)))


def make_rod_rows():
    for mass, words in ((1.0, "equal masses"), (100.0, "100:1"), (0.01, "1:100")):
        scene, scale = partial(double, mass), G * 100 * (mass + 2)
        yield Row(f"double pendulum: {words}, energy for 20 s", KEPT, scene,
                  partial(energy_off, seconds=20, scale=scale), ENERGY, quick=mass == 1, **PUSH)
        yield Row(f"double pendulum: {words}, path for 0.6 s", TINY, scene,
                  partial(follows, seconds=0.6), late(2 * math.sqrt(2 * G * 200)), **PUSH)
    for links, seconds in ((3, 20), (10, 20), (40, 5)):
        level = partial(chain, links, (20.0, 0.0))
        fall = sum(G * 20 * i for i in range(1, links + 1))  # kg px²/s², of swinging down
        yield Row(f"chain: {links} links let go level, energy for {seconds} s", KEPT, level,
                  partial(energy_off, seconds=seconds, scale=fall), ENERGY, **PUSH)
        yield Row(f"chain: {links} links let go level, length", RIGID, level,
                  partial(ever_stretches, seconds=3), SEEN, quick=links == 10)
    for links, bob in ((10, 1.0), (50, 1.0), (10, 10.0), (10, 100.0), (10, 1000.0), (10, 1e5)):
        yield Row(f"chain: hangs, {links} links, {bob:g}:1 at the end", RIGID,
                  partial(chain, links, bob=bob), hangs, SEEN, quick=bob == 100)
    for links, weight in ((10, 0.2), (20, 0.3), (11, 1.5)):
        yield Row(f"bridge: {links} rods, weight {weight}",
                  "The shape in which all forces cancel stays.", partial(bridge, links, weight),
                  stays, SEEN)
    for mass in (1.0, 1000.0):
        yield Row(f"roof: {mass:g} kg on two rods", "Two rods hold it: it stays.",
                  partial(roof, mass), stays, SEEN, **PUSH)
    for fast, mass in ((100.0, 1.0), (1000.0, 1.0), (300.0, 20.0), (10_000.0, 1.0)):
        scene, scale = partial(tumbling, fast, mass), 2 * fast**2 * mass / (1 + mass)
        reach = 50 * 2 * fast * mass / (1 + mass)
        yield Row(f"dumbbell: {fast:g} px/s, 1:{mass:g}, angular momentum", "It is kept.", scene,
                  partial(moment_lost, which=(2,), scale=reach, seconds=10), law(1),
                  quick=fast == 1000)
        yield Row(f"dumbbell: {fast:g} px/s, 1:{mass:g}, energy", KEPT, scene,
                  partial(energy_off, seconds=10, scale=scale), ENERGY)
        yield Row(f"dumbbell: {fast:g} px/s, 1:{mass:g}, length", RIGID, scene,
                  partial(ever_stretches, seconds=2), SEEN)
    yield Row("dumbbell: tumbles as it falls, centre of mass",
              "The centre of mass moves as one ball would.",
              partial(tumbling, 300.0, 5.0, (0.0, G), (200.0, -300.0)), centre_off, late(G))
    for count, fast in ((12, 200.0), (6, 500.0)):
        scene, spin = partial(ring, count, fast), count * 100 * fast
        yield Row(f"ring: {count} rods at {fast:g} px/s, angular momentum", "It is kept.", scene,
                  partial(moment_lost, which=(2,), scale=spin, seconds=5), law(1), **PUSH)
        yield Row(f"ring: {count} rods at {fast:g} px/s, energy", KEPT, scene,
                  partial(energy_off, seconds=5, scale=count * fast**2 / 2), ENERGY, **PUSH)
    for degrees in (0, 45, 90):
        yield Row(f"strike: the end of a rod at {degrees}°",
                  "By momentum and energy: across the rod its end weighs one ball, along it two.",
                  partial(struck, degrees),
                  partial(velocity_off_after, exact=struck_exact(degrees), seconds=0.4, i=0),
                  law(300), quick=degrees == 90, **PUSH)


def make_spring_rows():
    for hertz in (1, 5):
        stiffness = (2 * math.pi * hertz) ** 2
        scene = partial(oscillator, stiffness)
        yield Row(f"spring: {hertz} Hz, path for 10 s", "It follows a cosine.", scene,
                  partial(follows, seconds=10), late(50 * 2 * math.pi * hertz))
        yield Row(f"spring: {hertz} Hz, swing after 30 s", "Energy is kept, and the swing with it.",
                  scene, partial(swing_off, seconds=30), ENERGY, quick=hertz == 1)
    for power in (4, 6, 9):
        yield Row(f"spring: k/m = 1e{power}/s², swing", "The swing never grows.",
                  partial(oscillator, 10.0**power), partial(swing_off, seconds=10, ever=True),
                  ENERGY)
    for damping in (1.0, 5.0, 20.0, 60.0):
        yield Row(f"spring: damping {damping:g} kg/s at k = 100", TINY,
                  partial(oscillator, 100.0, damping=damping),
                  partial(follows, seconds=4), late(500), quick=damping == 5)
    yield Row("spring: 1e4 with damping 400", TINY,
              partial(oscillator, 1e4, damping=400.0), partial(follows, seconds=1), late(5000))
    for stiffness in (1e2, 1e4, 1e6, 1e8):
        yield Row(f"springs: five hang at rest, k = {stiffness:.0e}",
                  "Each carries what hangs below it: the stretch is Σ i m g / k.",
                  partial(spring_chain, 5, stiffness, 0.0, True), stays, SEEN)
    for stiffness, damping in ((1e2, 5.0), (1e3, 20.0), (1e4, 20.0), (1e4, 200.0), (1e5, 200.0),
                               (1e6, 1000.0)):
        yield Row(f"springs: five come to rest, k = {stiffness:.0e}, damping {damping:g}",
                  "At rest damping does nothing: the stretch is Σ i m g / k.",
                  partial(spring_chain, 5, stiffness, damping, False),
                  partial(hangs_low, seconds=30 if stiffness < 1e4 else 10),
                  Bound(0.01, "one hundredth of the stretch"), quick=damping == 200)
    for fast in (200.0, 949.0):
        yield Row(f"ellipse: from {fast:g} px/s, path for 5 s",
                  "On a spring without length it goes around on one ellipse for ever.",
                  partial(ellipse, fast), partial(follows, seconds=5), late(max(fast, 949)))
        yield Row(f"ellipse: from {fast:g} px/s, angular momentum",
                  "A pull towards a point keeps it.", partial(ellipse, fast), ellipse_spin,
                  Bound(0.01, "kept; one hundredth, as for energy"))
    for mass in (1.0, 100.0):
        yield Row(f"loose pair: 1:{mass:g}, path for 3 s", TINY, partial(loose_pair, mass),
                  partial(follows, seconds=3), late(50 * math.sqrt(400 * (1 + 1 / mass))))
    yield Row("loose pair: turns, angular momentum", "It is kept.", partial(loose_pair, 3.0, 100.0),
              partial(moment_lost, which=(2,), scale=150 * 300.0, seconds=10), law(1))
    for number in (1, 3, 5):
        fast = 10 * 2 * 20 * math.sin(math.pi * number / 12)
        yield Row(f"mode {number} of five balls on springs, path for 3 s",
                  "Each mode keeps its shape and goes with a cosine.", partial(mode, number),
                  partial(follows, seconds=3), late(fast))
# fmt: on


def ellipse_spin(trial, scene):
    """Return the largest change of the angular momentum about the peg, as a share."""
    engine = trial.build(scene)
    start = scene.bodies[1].pos[0] * scene.bodies[1].vel[1]
    seen = watch(engine, 10, lambda: engine.read(1))
    return max(abs((s.x * s.vy - s.y * s.vx) / start - 1) for s in seen)
