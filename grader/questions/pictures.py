"""Draw films of a scene: the bodies at some moments; a click or a key plays all of it.

A picture is one SVG without scripts. It contains numbers only, no text of a submission.
"""

import math
import zlib
from collections.abc import Sequence
from dataclasses import dataclass

from grader.player.page import load_environment
from grader.questions.page import TEMPLATES
from grader.questions.question import Picture

MOMENTS = 4  # moments that a picture shows, the last one clearest
SPOKE = 0.85  # of a radius
USUAL_TOP, MOST_ABOVE, BOTTOM = 30.0, -120.0, 590.0  # px, size of a picture


@dataclass(frozen=True)
class Look:
    """The shape of a body: a disc if it has a radius, else a box."""

    radius: float  # px
    half: tuple[float, float]
    moves: bool
    place: tuple[float, float]  # of a static one


@dataclass(frozen=True)
class Film:
    """Rows at regular times: x, y, vx, vy, angle and omega of each body."""

    looks: Sequence[Look]
    rows: Sequence[Sequence[float]]
    seconds: float
    rods: Sequence[tuple[int, int]] = ()  # numbers of the bodies that each rod holds

    def place(self, row: int, body: int) -> tuple[float, float]:
        x, y = self.rows[row][6 * body : 6 * body + 2]
        return x, y

    def angle(self, row: int, body: int) -> float:
        return self.rows[row][6 * body + 4]

    def spoke(self, row: int, body: int) -> tuple[float, float]:
        """Return where a ball's spoke ends."""
        (x, y), angle = self.place(row, body), self.angle(row, body)
        long = SPOKE * self.looks[body].radius
        return x + long * math.cos(angle), y + long * math.sin(angle)

    @property
    def moving(self) -> list[int]:
        return [number for number, look in enumerate(self.looks) if look.moves]

    @property
    def loose(self) -> list[int]:
        """Return the bodies that move and are on no rod."""
        held = {end for rod in self.rods for end in rod}
        return [body for body in self.moving if body not in held]

    @property
    def moments(self) -> list[int]:
        """Return the rows that a picture shows, the last one among them."""
        last = len(self.rows) - 1
        return [round(last * (number + 1) / MOMENTS) for number in range(MOMENTS)]


def find_bounds(films: Sequence[Film]) -> tuple[float, float, float, float]:
    """Return the visible area of these films: the scene and a little above it."""
    tops = [
        film.place(row, body)[1] - film.looks[body].radius
        for film in films
        for body in film.moving
        for row in film.moments
    ]
    top = max(MOST_ABOVE, min([USUAL_TOP, *tops]))
    return 0.0, top, 900.0, BOTTOM - top


def measure_difference(one: Film, other: Film) -> float:
    """Return the largest distance of a centre or rim between two films, px."""
    apart = [0.0]
    for row in one.moments:
        for body in one.moving:
            turned = abs(one.angle(row, body) - other.angle(row, body)) % (2 * math.pi)
            rim = min(turned, 2 * math.pi - turned) * one.looks[body].radius
            apart += [math.dist(one.place(row, body), other.place(row, body)), rim]
    return max(apart)


def draw_film(film: Film, name: str, alt: str, frame: tuple[float, float, float, float]) -> Picture:
    """Draw the film; `frame` is x, y, width and height of what is shown, px."""
    # It separates a picture's clicks from others' and is the same in every run.
    key = f"film{zlib.crc32(repr([name, *film.rows[-1]]).encode())}"
    box = " ".join(f"{each:g}" for each in frame)
    template = load_environment(TEMPLATES).get_template("film.svg")
    drawn = template.render(film=film, key=key, box=box, alt=alt, spoke=SPOKE, degrees=math.degrees)
    return Picture(name, alt, drawn)
