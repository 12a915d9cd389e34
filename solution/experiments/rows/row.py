"""Define a row of the leaderboard: a scene, what physics says of it, and a bound on the error.

Every bound comes from physics or from what a person can see, never from an engine's results.
Lengths in px, times in s, masses in kg, y down.
"""

import math
from collections import namedtuple
from dataclasses import dataclass

from ..measures import run, velocity_off
from ..scenes import DT, G

H = DT / 4  # s, a substep

# The largest error allowed, and why.
Bound = namedtuple("Bound", "limit why")
SEEN = Bound(0.5, "half a pixel cannot be seen")  # px, of motion where none should be
STILL = Bound(0.1, "half a pixel in five seconds cannot be seen")  # px/s, at rest
ENERGY = Bound(0.01, "energy is kept; one hundredth is half that in speed")  # a share
CLOCK = Bound(1 / 3600, "the clock is off by a frame in a minute")  # a share of a period
AIM = Bound(0.01, "over 1000 px it misses by the radius of a ball")  # rad
NEVER = Bound(0.5, "bodies are solid: none")  # of a count that must be 0


@dataclass
class Row:
    """A question of physics. measure(trial, scene) returns an engine's error, 0 or more."""

    title: str
    physics: str  # one sentence
    make: object  # () -> Scene
    measure: object
    bound: Bound
    needs: tuple = ()  # features that an engine may lack, besides effects
    quick: bool = False  # whether the quick run has it


def law(scale):
    """Return the bound of an exact law: single precision may round a thousand steps."""
    return Bound(1e-4 * scale, "an exact law; 1 in 10,000 for rounding in single precision")


def late(speed):
    """Return the bound of a position (px): its motion in a substep. For a speed, give px/s²."""
    return Bound(speed * H, "the change in one substep of 1/480 s")


def run_for(trial, scene, seconds):
    """Return an engine that has run a scene for so many seconds."""
    engine = trial.build(scene)
    run(engine, seconds)
    return engine


def off(state, exact):
    """Return the largest error of the named numbers of a state, such as {"vx": 300}."""
    return max(abs(getattr(state, name) - value) for name, value in exact.items())


def off_after(trial, scene, seconds, **exact):
    """Return the largest error of the last body's named numbers after so many seconds."""
    return off(run_for(trial, scene, seconds).read(len(scene.bodies) - 1), exact)


def velocity_off_after(trial, scene, exact, seconds, i=1):
    """Return the error (px/s) of a body's velocity after so many seconds."""
    return velocity_off(run_for(trial, scene, seconds).read(i), exact)


def share_off(value, exact):
    return abs(value / exact - 1)


def fall_speed(height):
    """Return the speed (px/s) after a fall from this height (px)."""
    return math.sqrt(2 * G * height)
