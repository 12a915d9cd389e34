"""Rows about collisions: momentum, energy, angular momentum and symmetry. There is no gravity."""

import math
import random
from functools import partial

from ..measures import run, states, velocity_off
from ..scenes import BOUNCE, DT, Ball, Block, Scene, cradle, shuffled
from .row import AIM, ENERGY, SEEN, Bound, H, Row, law, off_after, run_for, velocity_off_after

SMOOTH = {"restitution": 1.0, "friction": 0.0}
FREE = ("Contacts", "Bounce")


def free(*balls, effects=FREE):
    return Scene(list(balls), effects, gravity=(0, 0))


def head_on(mass, e, fast=300.0):
    ideal = {"restitution": e, "friction": 0.0}
    return free(Ball((-100, 0), vel=(fast, 0), **ideal), Ball((0, 0), mass=mass, **ideal))


def after_head_on(trial, scene, seconds=1):
    """Return the larger error (px/s) of the velocities of two balls that met along x."""
    engine, (a, b) = run_for(trial, scene, seconds), scene.bodies
    common = (a.mass * a.vel[0] + b.mass * b.vel[0]) / (a.mass + b.mass)
    exact = [common + a.restitution * (common - ball.vel[0]) for ball in (a, b)]
    return max(velocity_off(engine.read(i), (exact[i], 0)) for i in (0, 1))


def oblique(offset, fast, mass=1.0, frame=(0.0, 0.0), turn=0.0, shift=0.0, **surface):
    """Make a ball that hits another one off its middle by `offset` widths, in a moving frame."""
    c, s = math.cos(turn), math.sin(turn)

    def put(x, y):
        return c * x - s * y + shift, s * x + c * y + shift

    surface = {**SMOOTH, **surface}
    vel = c * fast + frame[0], s * fast + frame[1]
    a = Ball(put(-100, 20 * offset), vel=vel, **surface)
    b = Ball(put(0, 0), mass=mass, vel=frame, **surface)
    return free(a, b, effects=BOUNCE if surface["friction"] else FREE)


def travel(scene):
    """Return the time (s) in which the first ball goes 200 px relative to the second."""
    a, b = scene.bodies[:2]
    return 200 / math.dist(a.vel, b.vel)


def direction_off(trial, scene, offset):
    """Return the angle (rad) between the struck ball's way and the line of centres at the touch."""
    state = run_for(trial, scene, travel(scene)).read(1)
    return abs(math.atan2(state.vy, state.vx) + math.asin(offset))


def oblique_exact(offset, fast, mass):
    """Return both velocities after an elastic hit."""
    nx, ny = math.sqrt(1 - offset**2), -offset
    along = 2 * fast * nx / (1 + mass)
    return (fast - mass * along * nx, -mass * along * ny), (along * nx, along * ny)


def oblique_off(trial, scene, offset, fast, frame=(0.0, 0.0), turn=0.0):
    """Return the larger error of both velocities, as a share of the speed."""
    engine = run_for(trial, scene, travel(scene))
    exact = oblique_exact(offset, fast, scene.bodies[1].mass)
    c, s = math.cos(turn), math.sin(turn)
    turned = [(c * x - s * y + frame[0], s * x + c * y + frame[1]) for x, y in exact]
    return max(velocity_off(engine.read(i), turned[i]) for i in (0, 1)) / fast


def moments(scene, now):
    """Return momentum along x and y, and angular momentum about the origin, spins included."""
    pairs = list(zip(scene.bodies, now, strict=True))
    px = sum(b.mass * s.vx for b, s in pairs)
    py = sum(b.mass * s.vy for b, s in pairs)
    spin = sum(b.mass * (s.x * s.vy - s.y * s.vx + b.radius**2 / 2 * s.omega) for b, s in pairs)
    return px, py, spin


def moment_lost(trial, scene, which, scale, seconds=None):
    """Return the largest change of these moments, as a share of scale."""
    engine = trial.build(scene)
    start = moments(scene, states(engine))
    run(engine, seconds or travel(scene))
    end = moments(scene, states(engine))
    return max(abs(end[i] - start[i]) for i in which) / scale


def kinetic(scene, now):
    pairs = [(scene.bodies[i], now[i]) for i in scene.moving()]
    return sum(b.mass * (s.vx**2 + s.vy**2 + (b.radius * s.omega) ** 2 / 2) / 2 for b, s in pairs)


def energy_gain(engine, scene, seconds, dt=DT):
    """Return the change of the energy of motion in the end, as a share of that now."""
    start = kinetic(scene, states(engine))
    run(engine, seconds, dt)
    return kinetic(scene, states(engine)) / start - 1


def energy_off(trial, scene, seconds, may_fall=False):
    """Return the size of the change of the energy of motion, or its rise if it may fall."""
    gain = energy_gain(trial.build(scene), scene, seconds)
    return max(0.0, gain) if may_fall else abs(gain)


def back_again(trial, scene, seconds):
    """Reverse all velocities halfway; return the largest distance (px) from the start."""
    engine = run_for(trial, scene, seconds)
    for i, state in enumerate(states(engine)):
        engine.throw(i, (-state.vx, -state.vy))
    run(engine, seconds)
    places = [body.pos for body in scene.bodies]
    return max(math.dist(s[:2], p) for s, p in zip(states(engine), places, strict=True))


# ---------------------------------------------------------------- several at once


def cradle_off(trial, scene, thrown):
    """Return the largest error (px/s) of any ball: as many must leave as came."""
    engine = run_for(trial, scene, 1.5)
    count, fast = len(scene.bodies), scene.bodies[0].vel[0]
    exact = [fast if i >= count - thrown else 0.0 for i in range(count)]
    return max(abs(engine.read(i).vx - exact[i]) for i in range(count))


def into_valley(degrees, e=1.0, free_balls=False, fast=300.0):
    """Make a ball that flies down between two others, with normals `degrees` off upright."""
    a = math.radians(degrees)
    surface = {"restitution": e, "friction": 0.0}
    sides = [
        Ball((sign * 20 * math.sin(a), 20 * math.cos(a)), mass=float(free_balls), **surface)
        for sign in (-1, 1)
    ]
    return free(*sides, Ball((0, -100), vel=(0, fast), **surface))


def around(count, fast=300.0, centre=True):
    """Make balls that fly to the middle from all sides."""
    balls = []
    for i in range(count):
        a = 2 * math.pi * i / count
        x, y = math.cos(a), math.sin(a)
        balls.append(Ball((150 * x, 150 * y), vel=(-fast * x, -fast * y), **SMOOTH))
    return free(*[Ball((0, 0), **SMOOTH)] * centre, *balls)


def comes_back(trial, scene):
    """Return the largest distance (px/s) of any ball from its reversed velocity."""
    engine = run_for(trial, scene, 0.8)
    first = len(scene.bodies) % 2  # with a ball in the middle
    flying = list(enumerate(scene.bodies))[first:]
    return max(velocity_off(engine.read(i), [-v for v in body.vel]) for i, body in flying)


def rack(rows, fast):
    """Make the break of a rack of balls that touch; it is its own mirror image."""
    balls = [Ball((-100, 0), vel=(fast, 0), **SMOOTH)]
    step = 20 * math.sqrt(3) / 2
    for i in range(rows):
        balls += [Ball((i * step, 20 * (j - i / 2)), **SMOOTH) for j in range(i + 1)]
    return free(*balls)


def mirror_off(trial, scene, rows, fast):
    """Return the largest distance (px) of a ball from its mirror image, after 300 px of flight."""
    engine = run_for(trial, scene, 300 / fast)
    worst, first = abs(engine.read(0).y), 1
    for i in range(rows):
        for j in range(i + 1):
            a, b = engine.read(first + j), engine.read(first + i - j)
            worst = max(worst, math.hypot(a.x - b.x, a.y + b.y))
        first += i + 1
    return worst


def order_matters(trial, scene, seconds):
    """Return the largest change (px) of end positions if bodies are shuffled."""
    other, order = shuffled(scene)
    first, second = (run_for(trial, one, seconds) for one in (scene, other))
    return max(math.dist(first.read(i)[:2], second.read(j)[:2]) for j, i in enumerate(order))


def gas(count=20, masses=(1.0,), seed=3, e=1.0):
    """Make balls that fly in a closed box, with no overlap at the start."""
    rng = random.Random(seed)
    reach = 24 * (max(6, math.ceil(math.sqrt(count))) - 1)
    far, half = reach + 80, reach + 130
    walls = [
        Block((x, y), (half if y else 50, 50 if y else half), e, 0.0)
        for x, y in ((0, -far), (0, far), (-far, 0), (far, 0))
    ]
    places = range(-reach, reach + 1, 48)
    cells = [(x, y) for x in places for y in places]
    balls = []
    for cell in rng.sample(cells, count):
        mass, vel = rng.choice(masses), (rng.uniform(-300, 300), rng.uniform(-300, 300))
        balls.append(Ball(cell, 10, mass, vel, restitution=e, friction=0.0))
    return Scene([*walls, *balls], FREE, gravity=(0, 0))


# fmt: off
def make_hit_rows():
    hit = "Newton's law and momentum give both velocities."
    for mass in (1.0, 10.0, 1000.0, 0.001):
        for e in (0.0, 0.5, 1.0):
            yield Row(f"hit: head on, 1:{mass:g}, e = {e}", hit, partial(head_on, mass, e),
                      after_head_on, law(300), quick=mass == 1000)
    for offset in (0.25, 0.5, 0.75):
        for fast in (100.0, 500.0, 1500.0):
            yield Row(f"hit: {offset} widths off the middle at {fast:g} px/s",
                      "Without friction it leaves along the line of centres at the touch.",
                      partial(oblique, offset, fast), partial(direction_off, offset=offset), AIM,
                      quick=fast == 500)
    for mass in (0.1, 100.0):
        yield Row(f"hit: 0.5 widths off the middle at 500 px/s, 1:{mass:g}",
                  "Momentum and energy along the line of centres give both velocities.",
                  partial(oblique, 0.5, 500.0, mass),
                  partial(oblique_off, offset=0.5, fast=500.0), AIM)
    for words, change in (("in a frame that moves at 2000 px/s", {"frame": (2000.0, 700.0)}),
                          ("turned by 37°", {"turn": math.radians(37)})):
        yield Row(f"hit: 0.5 widths off the middle at 300 px/s, {words}",
                  "The laws are the same in every direction and in every frame that moves evenly.",
                  partial(oblique, 0.5, 300.0, **change),
                  partial(oblique_off, offset=0.5, fast=300.0, **change), AIM)
    yield Row("hit: 0.5 widths off the middle, 100,000 px away",
              "The laws are the same everywhere.", partial(oblique, 0.5, 300.0, shift=1e5),
              partial(oblique_off, offset=0.5, fast=300.0), AIM)
    for fast in (100.0, 500.0, 1500.0):
        rough = partial(oblique, 0.5, fast, friction=0.6, restitution=0.5)
        yield Row(f"hit: rough, off the middle at {fast:g} px/s, momentum", "Momentum is kept.",
                  rough, partial(moment_lost, which=(0, 1), scale=fast), law(1))
        yield Row(f"hit: rough, off the middle at {fast:g} px/s, angular momentum",
                  "Two bodies that push each other at one point keep their angular momentum.",
                  rough, partial(moment_lost, which=(2,), scale=20 * fast), law(1),
                  quick=fast == 500)
    yield Row("hit: three balls, then all reversed",
              "Elastic hits run backwards as well: the balls return to their start.",
              lambda: free(Ball((-100, 3), vel=(200, 0), **SMOOTH), Ball((0, 0), **SMOOTH),
                           Ball((60, 9), vel=(-50, 0), **SMOOTH)),
              partial(back_again, seconds=1), Bound(4 * 2 * 200 * H, "a substep of motion at each "
              "of four hits, and twice that in direction"))


def make_many_rows():
    mirror = "A scene that is its own mirror image stays so."
    sideways = partial(off_after, seconds=0.8, vx=0.0)  # of the last ball, which flies in
    stays_there = partial(velocity_off_after, exact=(0, 0), seconds=0.8, i=0)
    cradle_words = "As many balls leave as came, at the same speed: momentum and energy are kept."
    for count, thrown, gap in ((5, 1, 0.0), (5, 2, 0.0), (5, 3, 0.0), (10, 1, 0.0), (20, 1, 0.0),
                               (5, 2, 0.5), (10, 4, 0.01)):
        yield Row(f"cradle: {thrown} of {count} balls, gaps of {gap:g} px", cradle_words,
                  partial(cradle, count, thrown, gap), partial(cradle_off, thrown=thrown),
                  law(300), quick=count == 5)
    for degrees in (30, 45, 60):
        valley = partial(into_valley, degrees)
        yield Row(f"two at once: valley of {degrees}°, sideways", mirror, valley, sideways,
                  law(300), quick=degrees == 30)
        yield Row(f"two at once: valley of {degrees}°, speed back",
                  "By symmetry and energy it leaves as it came.", valley,
                  partial(off_after, seconds=0.8, vy=-300.0), law(300))
    yield Row("two at once: valley of 30°, e = 0.5, sideways", mirror,
              partial(into_valley, 30, 0.5), sideways, law(300))
    pair = partial(into_valley, 30, free_balls=True)
    yield Row("two at once: on two balls that touch, sideways", mirror, pair, sideways, law(300),
              quick=True)
    yield Row("two at once: on two balls that touch, speed back",
              "Symmetry, momentum and energy leave one answer: it bounces back at v/5.", pair,
              partial(off_after, seconds=0.8, vy=-60.0), law(300))
    for count in (2, 3, 5, 6):
        yield Row(f"all at once: {count} balls from all sides, the one in the middle",
                  "Impulses from all sides cancel.", partial(around, count), stays_there, law(300))
        yield Row(f"all at once: {count} balls from all sides, the others",
                  "By symmetry and energy each goes back as it came.", partial(around, count),
                  comes_back, law(300), quick=count == 3)
    for rows, fast in ((2, 300.0), (3, 300.0), (5, 300.0), (5, 1500.0)):
        yield Row(f"rack: {rows} rows at {fast:g} px/s, mirror image", mirror,
                  partial(rack, rows, fast), partial(mirror_off, rows=rows, fast=fast), SEEN,
                  quick=rows == 3)
        yield Row(f"rack: {rows} rows at {fast:g} px/s, energy", "With e = 1 energy is kept.",
                  partial(rack, rows, fast), partial(energy_off, seconds=300 / fast), ENERGY)
    yield Row("rack: 5 rows, added in another order", "The order of a list is no physics.",
              partial(rack, 5, 300.0), partial(order_matters, seconds=1), SEEN)
    yield Row("rack: 5 rows, momentum", "Momentum is kept.", partial(rack, 5, 1000.0),
              partial(moment_lost, which=(0, 1), scale=1000.0, seconds=0.5), law(1))
    for words, masses in (("equal", (1.0,)), ("1:100", (1.0, 100.0))):
        yield Row(f"gas: 20 balls of {words} masses for 20 s, energy", "With e = 1 energy is kept.",
                  partial(gas, 20, masses), partial(energy_off, seconds=20), ENERGY,
                  quick=words == "equal")
    yield Row("gas: 20 balls, e = 0.9, gain", "A hit with e < 1 never adds energy.",
              partial(gas, 20, (1.0, 10.0), 5, 0.9), partial(energy_off, seconds=5, may_fall=True),
              Bound(1e-4, "none; 1 in 10,000 for rounding"))
