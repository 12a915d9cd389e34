"""Measure every engine in the same way. Lengths in px, speeds in px/s.

Geometry comes from the scene's data and the bodies' positions, never from an engine's contacts.
"""

import math
from dataclasses import replace

import numpy as np

from .reference import Accelerations
from .scenes import DT, Ball, G


class GaveUp(Exception):
    """Raised when an engine gives up before anything is measured; the message says how."""


def run(engine, seconds, dt=DT):
    """Step an engine on."""
    for _ in range(round(seconds / dt)):
        engine.step(dt)


def watch(engine, seconds, measure, dt=DT):
    """Return what measure() returns after each step."""
    seen = []
    for _ in range(round(seconds / dt)):
        engine.step(dt)
        seen.append(measure())
    return seen


def states(engine):
    """Return the states of all bodies, in the scene's order."""
    return [engine.read(i) for i in range(len(engine.scene.bodies))]


def speed(state):
    return math.hypot(state.vx, state.vy)


def velocity_off(state, velocity):
    return math.hypot(state.vx - velocity[0], state.vy - velocity[1])


def top_speed(engine):
    """Return the speed of the fastest ball."""
    return max(speed(engine.read(i)) for i in engine.scene.moving())


def bits(engine):
    """Return every number of every body with all its bits, as text."""
    return [float(number).hex() for state in states(engine) for number in state]


def finite(engine):
    """Return true if no number of any body is NaN or infinite."""
    return all(math.isfinite(number) for state in states(engine) for number in state)


def overlap(ball, at, other, there):
    """Return the overlap of a ball and another ball or a block; negative if they are apart."""
    x, y = at.x - there.x, at.y - there.y
    if isinstance(other, Ball):
        return ball.radius + other.radius - math.hypot(x, y)
    out_x, out_y = abs(x) - other.half[0], abs(y) - other.half[1]
    if out_x < 0 and out_y < 0:
        return ball.radius - max(out_x, out_y)
    return ball.radius - math.hypot(max(out_x, 0), max(out_y, 0))


def deepest_overlap(engine):
    """Return the deepest overlap of any two bodies, or 0. Static or tied pairs do not count."""
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
    """Return the change of each rod's length since the start."""
    bodies = engine.scene.bodies
    found = []
    for a, b in engine.scene.rods:
        here, there = engine.read(a), engine.read(b)
        length = math.dist(bodies[a].pos, bodies[b].pos)
        found.append(abs(math.hypot(there.x - here.x, there.y - here.y) - length))
    return found


def worst_stretch(engine):
    return max(stretches(engine), default=0.0)


def energy_height(engine, i, dt=DT):
    """Return the height above y = 0 that a ball could reach with its energy.

    An engine's velocities lag behind its positions; gravity over that lag is added.
    """
    state = engine.read(i)
    vy = state.vy + G * engine.lag(dt)
    return (state.vx**2 + vy**2) / (2 * G) - state.y


def energy(engine, dt=DT):
    """Return the energy of all balls (kg px²/s²): flight, spin, height and springs."""
    scene = engine.scene
    gx, gy = scene.gravity
    total, lags = 0.0, lag_velocities(engine, dt)
    for i in scene.moving():
        body, state = scene.bodies[i], engine.read(i)
        vx, vy = state.vx + lags[i][0], state.vy + lags[i][1]
        flight = (vx**2 + vy**2) / 2 + (body.radius * state.omega) ** 2 / 4
        total += body.mass * (flight - gx * state.x - gy * state.y)
    for s in scene.springs:
        a, b = engine.read(s.a), engine.read(s.b)
        total += s.stiffness / 2 * (math.hypot(b.x - a.x, b.y - a.y) - s.length) ** 2
    return total


def lag_velocities(engine, dt):
    """Return how much gravity changes each body's velocity (px/s) over the engine's lag.

    Rods carry their part of it: a ball that hangs at rest gains nothing.
    """
    rods = engine.scene.rods if "Rods" in engine.scene.effects else []
    positions = np.array([state[:2] for state in states(engine)])
    accelerate = Accelerations(replace(engine.scene, rods=rods, springs=[]))
    return engine.lag(dt) * accelerate(positions, np.zeros_like(positions))
