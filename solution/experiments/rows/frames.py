"""Rows once more in other units of length, and turned: no law knows a unit or a direction."""

from dataclasses import replace

from ..engines import State
from ..scenes import Ball

UNITS = {0.01: "in metres (1 m is 100 px)", 30.0: "in thirtieths of a pixel"}
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
    """An engine that runs a changed scene, and is read and thrown in px as the scene was meant."""

    def __init__(self, engine, scene, change):
        self.engine, self.scene, self.change = engine, scene, change

    def __getattr__(self, name):
        return getattr(self.engine, name)

    def step(self, dt):
        self.engine.step(dt)

    def read(self, i):
        s = self.engine.read(i)
        (x, y), (vx, vy) = self.change.back(s.x, s.y), self.change.back(s.vx, s.vy)
        return State(x, y, vx, vy, s.angle, s.omega)

    def throw(self, i, velocity):
        self.engine.throw(i, self.change.there(*velocity))


class Unit:
    """Lengths in another unit."""

    def __init__(self, unit):
        self.unit = unit

    def there(self, x, y):
        return x * self.unit, y * self.unit

    def back(self, x, y):
        return x / self.unit, y / self.unit

    def sizes(self, x, y):
        return self.there(x, y)


class Turn:
    """Everything turned by a quarter: down becomes left."""

    unit = 1.0

    def there(self, x, y):
        return -y, x

    def back(self, x, y):
        return y, -x

    def sizes(self, x, y):
        return y, x


def changed(scene, change):
    """Return the scene as the change has it."""
    unit, bodies = change.unit, []
    for b in scene.bodies:
        pos = change.there(*b.pos)
        if isinstance(b, Ball):
            bodies.append(replace(b, pos=pos, radius=b.radius * unit, vel=change.there(*b.vel)))
        else:
            bodies.append(replace(b, pos=pos, half=change.sizes(*b.half)))
    springs = [replace(s, length=s.length * unit) for s in scene.springs]
    gravity = change.there(*scene.gravity)
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
    """Yield rows of those given, in other units and turned."""
    from functools import partial

    known = {row.title: row for row in rows}
    for titles, changes in (
        (TITLES, {words: Unit(unit) for unit, words in UNITS.items()}),
        (TURNED, {"turned by a quarter": Turn()}),
    ):
        for words, change in changes.items():
            for title in titles:
                row = known[title]
                measure = partial(measure_elsewhere, measure=row.measure, change=change)
                yield replace(row, title=f"{title}, {words}", measure=measure, quick=False)
