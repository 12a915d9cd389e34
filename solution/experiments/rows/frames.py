"""Rows repeated in other units of length, and turned: laws know no unit or direction.

A change is a complex number that multiplies x + y i: 0.01 is another unit, i a quarter turn.
"""

from dataclasses import replace
from functools import partial

from ..engines import State
from ..scenes import Ball

UNITS = {"in metres (1 m is 100 px)": 0.01, "in thirtieths of a pixel": 30.0}
QUARTER = {"turned by a quarter": 1j}  # down becomes left
TITLES = (
    "bounce: first rebound, e = 0.5",
    "bounce: from 50 px, e = 1.0",
    "hit: 0.5 widths off the middle at 500 px/s",
    "roll: from 300 px/s, spin 0/s, μ 0.6, radius 10",
    "slope: 10°, rolls",
    "tower: 10 equal balls, top",
    "tower: 10 equal balls, late speed",
    "heavy on light: 1:100",
    "pendulum: from 90°, period",
    "chain: hangs, 10 links, 10:1 at the end",
    "spring: 1 Hz, path for 10 s",
    "sleep: thrown up, at 10 px/s²",
    "bad start: two balls overlap by 30 px, speed",
    "rained pile: 40 balls, overlap",
)
TURNED = (
    "bounce: first rebound, e = 0.5",
    "roll: from 300 px/s, spin 0/s, μ 0.6, radius 10",
    "tower: 10 equal balls, top",
    "seams: hops at 300 px/s",
)


class Other:
    """An engine that runs a changed scene; its numbers are in px of the unchanged one."""

    def __init__(self, engine, scene, change):
        self.engine, self.scene, self.change = engine, scene, change

    def __getattr__(self, name):
        return getattr(self.engine, name)

    def read(self, i):
        s = self.engine.read(i)
        back = 1 / self.change
        place, velocity = times((s.x, s.y), back), times((s.vx, s.vy), back)
        return State(*place, *velocity, s.angle, s.omega)

    def throw(self, i, velocity):
        self.engine.throw(i, times(velocity, self.change))


def times(vector, change):
    """Return a vector multiplied by a change."""
    number = complex(*vector) * change
    return number.real, number.imag


def changed(scene, change):
    """Return the changed scene."""
    unit, bodies = abs(change), []
    for b in scene.bodies:
        pos = times(b.pos, change)
        if isinstance(b, Ball):
            bodies.append(replace(b, pos=pos, radius=b.radius * unit, vel=times(b.vel, change)))
        else:
            bodies.append(replace(b, pos=pos, half=tuple(map(abs, times(b.half, change)))))
    springs = [replace(s, length=s.length * unit) for s in scene.springs]
    gravity = times(scene.gravity, change)
    return replace(scene, bodies=bodies, springs=springs, gravity=gravity, unit=unit)


class Elsewhere:
    """A trial whose engines run the changed scene."""

    def __init__(self, trial, change):
        self.trial, self.change = trial, change

    def build(self, scene):
        return Other(self.trial.build(changed(scene, self.change)), scene, self.change)


def measure_elsewhere(trial, scene, measure, change):
    return measure(Elsewhere(trial, change), scene)


def make_rows(rows):
    """Yield some given rows in other units and turned."""
    known = {row.title: row for row in rows}
    for titles, changes in ((TITLES, UNITS), (TURNED, QUARTER)):
        for words, change in changes.items():
            for title in titles:
                row = known[title]
                measure = partial(measure_elsewhere, measure=row.measure, change=change)
                yield replace(row, title=f"{title}, {words}", measure=measure, quick=False)
