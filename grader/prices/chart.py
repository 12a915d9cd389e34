"""The curves of one scene as a drawing: logs of error (px) over logs of opcodes."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from grader.prices.front import Owned, front
from grader.prices.listing import Asked, PriceList
from grader.prices.measure import LEAST, Curve, Point, Prices
from grader.prices.others import IN_C, LESSON, STABLE

WIDTH, HEIGHT = 460, 400
LEFT, RIGHT, TOP, BOTTOM = 58, 14, 44, 46  # px around the curves; at the top stand who gave up
EDGE = 22  # px from the top, of those who gave up
KINDS = {LESSON: "lesson", STABLE: "stable"}


@dataclass(frozen=True)
class Line:
    """One engine: a class for its looks, its curve, its dots, and what is said of each."""

    name: str
    kind: str
    places: list[tuple[float, float]]
    words: list[str]

    @property
    def path(self) -> str:
        return " ".join(f"{x:g},{y:g}" for x, y in self.places)

    @property
    def dots(self) -> str:
        return "".join(f"M{x:g} {y:g}h0" for x, y in self.places)


@dataclass(frozen=True)
class Tick:
    at: float
    words: str


@dataclass(frozen=True)
class Level:
    """The error of an engine whose cost nobody can count."""

    name: str
    at: float
    words: str


@dataclass(frozen=True)
class Chart:
    """All that a page shows of one scene."""

    asked: Asked
    lines: list[Line]
    edge: list[Line]  # who gave up; each has one place
    levels: list[Level]
    across: list[Tick]
    up: list[Tick]
    front: list[Owned] = field(default_factory=list)
    step: str = ""  # the front as a line

    @property
    def leaders(self) -> list[tuple[list[str], Point]]:
        """The points of the front, each with all whose it is."""
        found: dict[tuple[int, float], tuple[list[str], Point]] = {}
        for name, point in self.front:
            found.setdefault((point.opcodes, point.error), ([], point))[0].append(name)
        return list(found.values())

    @property
    def gave_up(self) -> list[tuple[str, list[str]]]:
        """The reasons, each with the names of those it holds for; what most have comes first."""
        names: dict[str, list[str]] = {}
        for line in self.edge:
            names.setdefault(line.words[0], []).append(line.name)
        return sorted(names.items(), key=lambda each: (-len(each[1]), each[0]))


@dataclass(frozen=True)
class Scale:
    """From numbers to places, in logs."""

    low: float
    high: float
    begin: float  # px
    end: float

    def __call__(self, value: float) -> float:
        share = math.log(value / self.low) / math.log(self.high / self.low)
        return round(self.begin + share * (self.end - self.begin), 1)

    def ticks(self, words: Callable[[float], str]) -> list[Tick]:
        """At 1, 2 and 5 of each decade, or at the decades alone where there are many."""
        decades = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        parts = (1, 2, 5) if math.log10(self.high / self.low) < 2.5 else (1,)
        values = (float(f"{part}e{decade}") for decade in decades for part in parts)
        return [Tick(self(each), words(each)) for each in values if self.low <= each <= self.high]


def charts(prices: PriceList, own: str = "") -> list[Chart]:
    """A drawing of each scene; of the class, or with the curve of `own` alone."""
    engines = [each for each in prices.engines if own in ("", each.name)]
    return [chart(scene, engines, prices.others, own) for scene in prices.scenes]


def chart(asked: Asked, engines: Sequence[Prices], others: Sequence[Prices], own: str) -> Chart:
    mine = [(each.name, each.curve(asked.id)) for each in engines]
    theirs = [(each.name, each.curve(asked.id)) for each in others if each.name not in IN_C]
    silent = [(each.name, each.curve(asked.id)) for each in others if each.name in IN_C]
    points = [point for _, curve in mine + theirs for point in curve.points]
    levels = [usual(asked, curve) for _, curve in silent]
    errors = [point.error for point in points] + [each.error for each in levels if each]
    x = scale([point.opcodes for point in points] or [1e5, 1e6], LEFT, WIDTH - RIGHT)
    y = scale(errors or [0.1, 10.0], HEIGHT - BOTTOM, TOP)
    found = [] if own else front(owned(mine))
    kind = "own" if own else "engine"
    lines = [line(name, kind, curve, x, y) for name, curve in mine]
    known = [line(name, KINDS[name], curve, x, y) for name, curve in theirs]
    lines = known + lines if own else lines + known  # the last one lies on top
    return Chart(
        asked,
        [each for each in lines if each.places],
        list(at_the_edge([each for each in mine + theirs if each[1].gave_up])),
        [
            Level(name, y(each.error), f"{name}, {each.setting}: {in_px(each.error)}")
            for (name, _), each in zip(silent, levels, strict=True)
            if each
        ],
        x.ticks(in_opcodes),
        y.ticks(in_px),
        found,
        stepped([(x(each.opcodes), y(each.error)) for _, each in found]),
    )


def owned(curves: Iterable[tuple[str, Curve]]) -> Iterator[Owned]:
    return ((name, point) for name, curve in curves for point in curve.points)


def usual(asked: Asked, curve: Curve) -> Point | None:
    return next((each for each in curve.points if each.setting == asked.usual), None)


def scale(values: Sequence[float], begin: float, end: float) -> Scale:
    """With a tenth of a decade to spare on either side."""
    return Scale(min(values) / 1.25, max(values) * 1.25, begin, end)


def line(name: str, kind: str, curve: Curve, x: Scale, y: Scale) -> Line:
    points = sorted(curve.points, key=lambda each: each.opcodes)
    return Line(
        name,
        kind,
        [(x(each.opcodes), y(each.error)) for each in points],
        [told(each) for each in points],
    )


def told(point: Point) -> str:
    return f"{point.setting}: {in_px(point.error)} for {in_opcodes(point.opcodes)} opcodes"


def at_the_edge(curves: Sequence[tuple[str, Curve]]) -> Iterator[Line]:
    """Side by side at the top, in the order of names."""
    room = (WIDTH - LEFT - RIGHT) / (len(curves) + 1)
    for number, (name, curve) in enumerate(curves, 1):
        yield Line(name, "edge", [(round(LEFT + number * room, 1), EDGE)], [curve.gave_up])


def stepped(places: Sequence[tuple[float, float]]) -> str:
    """Along the front: so much is to be had for so many opcodes, until more buy less error."""
    if not places:
        return ""
    (x, y), *rest = places
    return f"M{x:g} {TOP}V{y:g}" + "".join(f"H{x:g}V{y:g}" for x, y in rest) + f"H{WIDTH - RIGHT}"


def in_opcodes(count: float) -> str:
    """A number of opcodes in three digits, by the thousand or the million."""
    if count >= 999_500:
        return f"{count / 1e6:.3g} M"
    return f"{count / 1e3:.3g} k" if count >= 1000 else f"{count:.3g}"


def in_px(error: float) -> str:
    return f"≤ {LEAST:g} px" if error <= LEAST else f"{error:.3g} px"
