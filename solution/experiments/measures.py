"""What is measured, the same for every engine. Lengths in px, speeds in px/s.

Geometry comes from the scene's data and the places of the bodies, never from an engine's contacts.
"""

import math

from .scenes import DT, Ball, G


class GaveUp(Exception):
    """An engine did not get to what is measured; the message is one word that says how."""


def run(engine, seconds, dt=DT):
    """Step an engine on."""
    for _ in range(round(seconds / dt)):
        engine.step(dt)


def watch(engine, seconds, measure, dt=DT):
    """What measure() says after each step."""
    seen = []
    for _ in range(round(seconds / dt)):
        engine.step(dt)
        seen.append(measure())
    return seen


def states(engine):
    """The states of all bodies, in the scene's order."""
    return [engine.read(i) for i in range(len(engine.scene.bodies))]


def speed(state):
    return math.hypot(state.vx, state.vy)


def top_speed(engine):
    """The speed of the fastest ball."""
    return max(speed(engine.read(i)) for i in engine.scene.moving())


def bits(engine):
    """Every number of every body with all its bits, as text."""
    return [float(number).hex() for state in states(engine) for number in state]


def finite(engine):
    """Whether no number of any body is NaN or infinite."""
    return all(math.isfinite(number) for state in states(engine) for number in state)


def overlap(ball, at, other, there):
    """How deep a ball is in another ball or a block, by their data and states; negative apart."""
    x, y = at.x - there.x, at.y - there.y
    if isinstance(other, Ball):
        return ball.radius + other.radius - math.hypot(x, y)
    out_x, out_y = abs(x) - other.half[0], abs(y) - other.half[1]
    if out_x < 0 and out_y < 0:
        return ball.radius - max(out_x, out_y)
    return ball.radius - math.hypot(max(out_x, 0), max(out_y, 0))


def deepest_overlap(engine):
    """The deepest overlap of any two bodies of which one can move, or 0. Tied ones do not count."""
    bodies, now = engine.scene.bodies, states(engine)
    moving, tied = engine.scene.moving(), {frozenset(rod) for rod in engine.scene.rods}
    deepest, seen = 0.0, set()
    for i in moving:
        seen.add(i)
        for j, other in enumerate(bodies):
            if j not in seen and frozenset((i, j)) not in tied:
                deepest = max(deepest, overlap(bodies[i], now[i], other, now[j]))
    return deepest


def stretches(engine):
    """How far each rod is from the length it starts with."""
    bodies = engine.scene.bodies
    found = []
    for a, b in engine.scene.rods:
        here, there = engine.read(a), engine.read(b)
        length = math.dist(bodies[a].pos, bodies[b].pos)
        found.append(abs(math.hypot(there.x - here.x, there.y - here.y) - length))
    return found


def worst_stretch(engine):
    return max(stretches(engine), default=0.0)


def sinking(engine, seconds, dt=DT):
    """How far the last ball comes down, how far it ever rises, and the top speed in the end."""
    top = engine.scene.moving()[-1]
    start = engine.read(top).y
    rises = watch(engine, seconds, lambda: start - engine.read(top).y, dt)
    return -rises[-1], max(0.0, *rises), top_speed(engine)


def swinging(engine, seconds, dt=DT):
    """A pendulum's largest stretch, mean period (s) and largest change of its energy height.

    The bob is body 1 and the peg at x = 0. The period is None before a second passage to the left.
    """
    start, x = energy_height(engine, 1, dt), engine.read(1).x
    stretch, change, passages = 0.0, 0.0, []
    for i in range(round(seconds / dt)):
        engine.step(dt)
        before, x = x, engine.read(1).x
        if x <= 0 < before:
            passages.append((i + before / (before - x)) * dt)
        stretch = max(stretch, worst_stretch(engine))
        change = max(change, energy_height(engine, 1, dt) - start, key=abs)
    rounds = len(passages) - 1
    period = (passages[-1] - passages[0]) / rounds if rounds > 0 else None
    return stretch, period, change


def energy_height(engine, i, dt=DT):
    """Height above y = 0 that a ball could reach with the energy of its flight.

    An engine's velocities belong to another moment than its places; gravity over that lag is added.
    """
    state = engine.read(i)
    vy = state.vy + G * engine.lag(dt)
    return (state.vx**2 + vy**2) / (2 * G) - state.y


def energy(engine, dt=DT):
    """Energy of all balls per kg of the heaviest, px²/s²: flight, spin, height and springs."""
    scene = engine.scene
    gx, gy = scene.gravity
    total = 0.0
    for i in scene.moving():
        body, state, lag = scene.bodies[i], engine.read(i), engine.lag(dt)
        vx, vy = state.vx + gx * lag, state.vy + gy * lag
        flight = (vx**2 + vy**2) / 2 + (body.radius * state.omega) ** 2 / 4
        total += body.mass * (flight - gx * state.x - gy * state.y)
    for s in scene.springs:
        a, b = engine.read(s.a), engine.read(s.b)
        total += s.stiffness / 2 * (math.hypot(b.x - a.x, b.y - a.y) - s.length) ** 2
    return total


def swing_energy(engine, dt=DT):
    """The energy of a chain that hangs from a peg, above the one it has at rest. See energy."""
    scene = engine.scene
    depth, rest = 0.0, 0.0
    for a, b in scene.rods:
        depth += math.dist(scene.bodies[a].pos, scene.bodies[b].pos)
        rest -= scene.bodies[b].mass * G * depth
    return energy(engine, dt) - rest
