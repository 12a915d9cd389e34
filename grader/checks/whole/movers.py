"""Find the discs that move in a program, and measure how they bounced and rolled.

Rolling is measured by speed and spin while a ball is on the floor, not by angles: a program may
reduce angles modulo 2 pi.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from grader.checks.whole.flights import moments
from grader.judge.lab import STEP, Moment
from grader.protocol import BodyValue, Played, SpaceBody

LEDGE_TOP, FLOOR_TOP = 250.0, 560.0  # px
RESTING = 3.0  # px, for a body that lies on another
LANDING = 9.0  # px: how deep a ball at 1000 px/s gets within one step
BOB_RADIUS = 24.0  # px; the balls are smaller
TENTH = 12  # steps in a tenth of a second
ROLLING = 20.0  # px/s, the speed from which a ball counts as rolling


@dataclass
class Mover:
    """A ball or the bob, and its trail since the last change in the number of bodies."""

    radius: float
    trail: list[Moment]

    @property
    def is_bob(self) -> bool:
        return self.radius == BOB_RADIUS

    @property
    def begin(self) -> tuple[float, float]:
        return self.trail[0].x, self.trail[0].y

    @property
    def tenths(self) -> list[Moment]:
        """Return a moment of each tenth of a second, ending with the last one."""
        return self.trail[::-TENTH][::-1]

    def bottom(self, moment: Moment) -> float:
        return moment.y + self.radius

    def lies_on(self, top: float, moment: Moment) -> bool:
        return abs(self.bottom(moment) - top) <= RESTING

    def slip(self, moment: Moment) -> float:
        """Return how fast its rim slides over a floor, px/s."""
        return abs(moment.vx - moment.omega * self.radius)

    def rolls(self, moment: Moment) -> bool:
        return self.slip(moment) <= 0.1 * abs(moment.vx) + 5.0

    @property
    def went_aside(self) -> float:
        """Return its largest distance from its start, to the left or right, px."""
        return max(abs(moment.x - self.trail[0].x) for moment in self.trail)

    @property
    def rolled_distance(self) -> float:
        """Return the distance that it rolled over the floor, px."""
        return sum(
            abs(moment.vx) * STEP
            for moment in self.trail
            if self.lies_on(FLOOR_TOP, moment) and abs(moment.vx) > ROLLING and self.rolls(moment)
        )

    @property
    def turned_angle(self) -> float:
        """Return the sum of its turns back and forth, rad."""
        return sum(abs(moment.omega) for moment in self.trail) * STEP

    @property
    def rise(self) -> float:
        """Return its highest rise after it first reached the floor, px; 0 if it never did."""
        landed = next((n for n, m in enumerate(self.trail) if self.lies_near_floor(m)), None)
        if landed is None:
            return 0.0
        lowest = max(self.trail[landed : landed + TENTH], key=self.bottom)
        after = self.trail[self.trail.index(lowest) :]
        return max(lowest.y - moment.y for moment in after)

    def lies_near_floor(self, moment: Moment) -> bool:
        return self.bottom(moment) >= FLOOR_TOP - RESTING


def movers(played: Played) -> list[Mover]:
    """Return the discs that can move."""
    rows = list(map(moments, played.trail))
    full = [row for row in rows if len(row) == len(rows[-1])]
    return [
        Mover(radius, [row[column] for row in full])
        for column, radius in columns(played, full[-1])
        if all(column < len(row) for row in full)
    ]


def columns(played: Played, last: list[Moment]) -> Iterator[tuple[int, float]]:
    """Return each disc's number in the rows of the trail, and its radius."""
    moving = [body for body in played.bodies if isinstance(body, BodyValue) and body.inv_mass]
    yield from ((number, body.radius) for number, body in enumerate(moving))
    for body in played.bodies:
        if isinstance(body, SpaceBody) and body.kind == "dynamic" and body.shapes:
            shape = body.shapes[0]
            if shape.kind == "Circle":
                yield nearest(last, (body.pos.x, body.pos.y)), shape.radius


def nearest(row: list[Moment], place: tuple[float, float]) -> int:
    return min(range(len(row)), key=lambda number: math.dist((row[number].x, row[number].y), place))
