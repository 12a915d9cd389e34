"""Three scenes whose answer is known, and the settings of each: the truth never leaves the judge.

Lengths in px, times in s, masses in kg, y down. A cost is opcodes per simulated second; an error is
in px, at the worst moment that was looked at.
"""

import math
import random
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

from grader.judge.decode import Pair, Thing
from grader.judge.lab import Lab, Moment

G = 980.0  # px/s²
RATE = 120  # steps per second, of the lesson
PASSES = 8  # of the solver, the lesson's
LOOKS = 60  # per second, at which bodies are looked at
GAP = 2.0  # px
SETTLED = 0.5  # s, after which a tower lies still; its top has 0.2 s to fall
AWAY = 0.25  # s that a tower has to fall in, once its floor is gone


@dataclass(frozen=True)
class Setting:
    """Where the dials of an engine stand."""

    rate: int = RATE  # steps per second
    passes: int = PASSES
    words: str = field(default="", compare=False)  # what is told of it


@dataclass(frozen=True)
class Built:
    """A scene in the child: its world, the bodies to look at, and the floor under them."""

    world: Thing
    watched: list[Thing]
    floor: Thing | None = None


@dataclass(frozen=True)
class Scene:
    """One scene: what an engine needs for it, how it is built, and where its bodies should be."""

    id: str
    title: str
    error: str  # what the error is
    needs: tuple[str, ...]  # TODOs
    seconds: float
    enough: int  # steps that take the lesson's engine a twentieth of a second
    settings: tuple[Setting, ...]
    build: Callable[[Lab], Built]  # in the child
    exact: Callable[[float], Sequence[Pair]]  # the places after so many seconds, of each body
    since: float = 0.0  # s, from which on they are known

    def steps(self, setting: Setting) -> int:
        return round(self.seconds * setting.rate)

    def worst(self, moments: Sequence[Sequence[Moment]]) -> float:
        """How far (px) any body is from where it should be, at the worst of the moments."""
        rows = zip(*moments, strict=True)
        return max(
            math.hypot(now.x - x, now.y - y)
            for number, row in enumerate(rows, 1)
            if number / LOOKS > self.since
            for now, (x, y) in zip(row, self.exact(number / LOOKS), strict=True)
        )


def by_passes(counts: Iterable[int]) -> tuple[Setting, ...]:
    return tuple(Setting(passes=n, words=f"{n} passes") for n in counts)


def by_step(rates: Iterable[int]) -> tuple[Setting, ...]:
    return tuple(Setting(rate=n, words=f"1/{n} s") for n in rates)


def scenes(seed: int | None = None) -> tuple[Scene, ...]:
    """The three scenes; under an instructor's secret seed with other sizes, masses and speeds."""
    drawn = random.Random(f"{seed} prices") if seed is not None else None

    def about(number: float) -> float:
        """The number, or one that is off by up to an eighth of it and never the same."""
        return number * (1 + drawn.choice([-1, 1]) * drawn.randint(1, 8) / 64) if drawn else number

    rates = by_step((60, 120, 240, 480))
    tower, swing, slide = (
        Tower(10, about(10.0), about(1.0)),
        Swing(about(140.0), about(90.0), about(6.0)),
        Slide(about(10.0), about(300.0), 0.6),
    )
    return (
        Scene(
            id="tower",
            title=f"A tower of {tower.count} balls that settles",
            error="how far a ball is from where it should lie at most",
            needs=("1", "2", "4"),
            seconds=1.0,
            enough=120,
            settings=by_passes((2, 4, 8, 16)),
            build=tower.build,
            exact=tower.exact,
            since=SETTLED,
        ),
        Scene(
            id="pendulum",
            title="A pendulum, let go at about 90°",
            error="how far the bob is from its exact way at most",
            needs=("3",),
            seconds=3.0,
            enough=4000,
            settings=rates,
            build=swing.build,
            exact=swing.exact,
        ),
        Scene(
            id="slide",
            title="A ball that slides, then rolls",
            error="how far the ball is from its exact way at most",
            needs=("1", "2", "4"),
            seconds=1.0,
            enough=500,
            settings=rates,
            build=slide.build,
            exact=slide.exact,
        ),
    )


# ---------------------------------------------------------------- a tower


@dataclass(frozen=True)
class Tower:
    """Equal balls above each other, GAP px apart, in a slot a little wider than they are.

    They fall on each other and should lie still then, none of them in another one.
    """

    count: int
    radius: float
    mass: float

    def places(self, gap: float = 0.0) -> list[Pair]:
        return [(0.0, -self.radius * (2 * i + 1) - gap * (i + 1)) for i in range(self.count)]

    def build(self, lab: Lab) -> Built:
        surface = {"restitution": 0.0, "friction": 0.6}
        side, high = 1.05 * self.radius + 20, self.radius * (self.count + 5)
        floor = lab.box((0.0, 20.0), (500.0, 20.0), **surface)
        walls = [lab.box((x, -high), (20.0, high), **surface) for x in (-side, side)]
        balls = [lab.circle(at, self.radius, self.mass, **surface) for at in self.places(GAP)]
        world = lab.world(floor, *walls, *balls, gravity=(0.0, G))
        return Built(world, balls, floor)

    def exact(self, seconds: float) -> Sequence[Pair]:
        return self.places()


# ---------------------------------------------------------------- a pendulum


@dataclass(frozen=True)
class Swing:
    """A bob on a rod from a peg at (0, 0), let go at rest at an angle from the vertical."""

    length: float
    degrees: float
    mass: float

    def build(self, lab: Lab) -> Built:
        peg = lab.circle((0.0, 0.0), 6.0, 0.0)
        bob = lab.circle(self.place(math.radians(self.degrees)), 24.0, self.mass)
        rod = lab.thing(lab.call("DistanceJoint", peg, bob), "a DistanceJoint")
        return Built(lab.world(peg, bob, gravity=(0.0, G), joints=[rod]), [bob])

    def place(self, angle: float) -> Pair:
        return self.length * math.sin(angle), self.length * math.cos(angle)

    def exact(self, seconds: float) -> Sequence[Pair]:
        """sin(angle / 2) = k cd(t sqrt(g / l), k), where k is its sine in the beginning."""
        k = math.sin(math.radians(self.degrees) / 2)
        return [self.place(2 * math.asin(k * cd(seconds * math.sqrt(G / self.length), k)))]


def cd(u: float, k: float) -> float:
    """Jacobi's elliptic function cn / dn of modulus k, by descending Landen transformations.

    Abramowitz and Stegun, Handbook of Mathematical Functions, 16.4.
    """
    a, b = 1.0, math.sqrt(1 - k**2)
    ratios = []
    while abs(a - b) > 1e-15 * a:
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        ratios.append(c / a)
    phi = 2 ** len(ratios) * a * u
    for ratio in reversed(ratios):
        phi = (phi + math.asin(ratio * math.sin(phi))) / 2
    return math.cos(phi) / math.sqrt(1 - (k * math.sin(phi)) ** 2)


# ---------------------------------------------------------------- a ball that slides


@dataclass(frozen=True)
class Slide:
    """A ball set down on a floor with a speed and no spin: it slides until it rolls.

    Friction slows it by mu g and spins it up; a disc rolls from v0 / (3 mu g) on, with 2/3 of v0.
    """

    radius: float
    speed: float
    friction: float

    def build(self, lab: Lab) -> Built:
        surface = {"restitution": 0.0, "friction": self.friction}
        floor = lab.box((0.0, 50.0), (5000.0, 50.0), **surface)
        at, flies = (0.0, -self.radius), (self.speed, 0.0)
        ball = lab.circle(at, self.radius, 1.0, vel=flies, **surface)
        return Built(lab.world(floor, ball, gravity=(0.0, G)), [ball])

    def exact(self, seconds: float) -> Sequence[Pair]:
        slows = self.friction * G
        slides = min(seconds, self.speed / (3 * slows))
        rolls = seconds - slides
        x = self.speed * slides - slows * slides**2 / 2 + 2 / 3 * self.speed * rolls
        return [(x, -self.radius)]
