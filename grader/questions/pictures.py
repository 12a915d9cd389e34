"""Films of a scene as pictures: where bodies are at some moments, and a click plays all of it.

A picture is one SVG that runs no script. Everything in it is a number: no word of a submission.
"""

import math
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape

from grader.questions.question import Picture

MOMENTS = 4  # at which a picture shows the bodies, the last one clearest
SPOKE = 0.85  # of a radius
USUAL_TOP, MOST_ABOVE, BOTTOM = 30.0, -120.0, 590.0  # px, of what a picture shows


@dataclass(frozen=True)
class Look:
    """What is drawn of a body: a disc where it has a radius, else a box."""

    radius: float  # px
    half: tuple[float, float]
    moves: bool
    place: tuple[float, float]  # of a static one


@dataclass(frozen=True)
class Film:
    """The rows of bodies, x, y, vx, vy, angle, omega, at equal distances in time."""

    looks: Sequence[Look]
    rows: Sequence[Sequence[float]]
    seconds: float
    rods: Sequence[tuple[int, int]] = ()  # numbers of the bodies that each holds

    def place(self, row: int, body: int) -> tuple[float, float]:
        x, y = self.rows[row][6 * body : 6 * body + 2]
        return x, y

    def angle(self, row: int, body: int) -> float:
        return self.rows[row][6 * body + 4]

    @property
    def moving(self) -> list[int]:
        return [number for number, look in enumerate(self.looks) if look.moves]

    @property
    def loose(self) -> list[int]:
        """What moves, and hangs on no rod."""
        held = {end for rod in self.rods for end in rod}
        return [body for body in self.moving if body not in held]

    @property
    def moments(self) -> list[int]:
        """The rows that a picture shows, the last one among them."""
        last = len(self.rows) - 1
        return [round(last * (number + 1) / MOMENTS) for number in range(MOMENTS)]


def frame_of(films: Sequence[Film]) -> tuple[float, float, float, float]:
    """What pictures of these films show alike: the scene, and what flies a little above it."""
    tops = [
        film.place(row, body)[1] - film.looks[body].radius
        for film in films
        for body in film.moving
        for row in film.moments
    ]
    top = max(MOST_ABOVE, min([USUAL_TOP, *tops]))
    return 0.0, top, 900.0, BOTTOM - top


def difference(one: Film, other: Film) -> float:
    """How far the films are apart for an eye, px: at the place or rim that differs most."""
    apart = [0.0]
    for row in one.moments:
        for body in one.moving:
            turned = abs(one.angle(row, body) - other.angle(row, body)) % (2 * math.pi)
            rim = min(turned, 2 * math.pi - turned) * one.looks[body].radius
            apart += [math.dist(one.place(row, body), other.place(row, body)), rim]
    return max(apart)


def picture(film: Film, name: str, alt: str, frame: tuple[float, float, float, float]) -> Picture:
    """The film as a picture; `frame` is x, y, width and height of what is shown, px."""
    key = "film" + number_of(name, film)
    parts = [still(look) for look in film.looks if not look.moves]
    parts += [trail(film, body) for body in film.moving]
    parts += [rim(film, body) for body in film.loose]
    for number, row in enumerate(film.moments, 1):
        shown = "".join(disc(film, row, body) for body in film.moving)
        rods = "".join(rod(film, row, *ends) for ends in film.rods)
        parts.append(f'<g opacity="{(number / MOMENTS) ** 2:.2f}">{rods}{shown}</g>')
    parts.append(f'<g opacity="0">{appears(key, film)}{moving_discs(key, film)}</g>')
    box = " ".join(f"{each:g}" for each in frame)
    drawn = (
        f'<svg xmlns="http://www.w3.org/2000/svg" id="{key}" viewBox="{box}" role="img" '
        f'aria-label="{escape(alt)}">{"".join(parts)}</svg>'
    )
    return Picture(name, alt, drawn)


# As attributes, so that a picture looks the same alone, as in Moodle; a page's style goes before.
FIXED, BALL, LINE, RIM = "#b3b9c6", "#1f6fd6", "#5a6275", "#c25700"


def number_of(name: str, film: Film) -> str:
    """A number by which a picture's clicks are told from those of others; the same in each run."""
    return str(zlib.crc32(repr([name, *film.rows[-1]]).encode()))


def still(look: Look) -> str:
    x, y = look.place
    if look.radius:
        return f'<circle class="fixed" fill="{FIXED}" cx="{x:g}" cy="{y:g}" r="{look.radius:g}"/>'
    wide, high = look.half
    return (
        f'<rect class="fixed" fill="{FIXED}" x="{x - wide:g}" y="{y - high:g}" '
        f'width="{2 * wide:g}" height="{2 * high:g}"/>'
    )


def trail(film: Film, body: int) -> str:
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in (film.place(n, body) for n in rows_of(film)))
    look = f'fill="none" stroke="{BALL}" stroke-width="2" opacity="0.3"'
    return f'<polyline class="trail" {look} points="{points}"/>'


def rim(film: Film, body: int) -> str:
    """The way of a spoke's end: on paper, too, one sees by it how a ball turns."""
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in (end(film, n, body) for n in rows_of(film)))
    return f'<polyline class="rim" fill="none" stroke="{RIM}" stroke-width="1" points="{points}"/>'


def end(film: Film, row: int, body: int) -> tuple[float, float]:
    """Where the spoke of a ball ends."""
    (x, y), angle = film.place(row, body), film.angle(row, body)
    long = SPOKE * film.looks[body].radius
    return x + long * math.cos(angle), y + long * math.sin(angle)


def rows_of(film: Film) -> range:
    return range(len(film.rows))


def disc(film: Film, row: int, body: int) -> str:
    (x, y), radius = film.place(row, body), film.looks[body].radius
    to_x, to_y = end(film, row, body)
    return (
        f'<circle class="ball" fill="{BALL}" cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}"/>'
        f'<line class="spoke" stroke="#fff" stroke-width="3" x1="{x:.1f}" y1="{y:.1f}" '
        f'x2="{to_x:.1f}" y2="{to_y:.1f}"/>'
    )


def rod(film: Film, row: int, first: int, second: int) -> str:
    (x1, y1), (x2, y2) = film.place(row, first), film.place(row, second)
    ends = f'x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"'
    return f'<line class="rod" stroke="{LINE}" stroke-width="3" {ends}/>'


def appears(key: str, film: Film) -> str:
    return f'<set attributeName="opacity" to="1" begin="{key}.click" dur="{film.seconds:g}s"/>'


def moving_discs(key: str, film: Film) -> str:
    """Each ball with its spoke, moved from row to row once the picture is clicked on; and rods."""
    timed = f'begin="{key}.click" dur="{film.seconds:g}s"'
    rows = rows_of(film)
    parts = []
    for first, second in film.rods:
        moves = "".join(
            animated(name, timed, (f"{film.place(row, body)[axis]:.1f}" for row in rows))
            for number, body in enumerate((first, second), 1)
            for axis, name in enumerate((f"x{number}", f"y{number}"))
        )
        parts.append(f'<line stroke="{LINE}" stroke-width="3">{moves}</line>')
    for body in film.moving:
        radius = film.looks[body].radius
        places = (f"{x:.1f} {y:.1f}" for x, y in (film.place(row, body) for row in rows))
        turns = (f"{math.degrees(film.angle(row, body)):.0f}" for row in rows)
        parts.append(
            f'<g>{turned("translate", timed, places)}<circle fill="{RIM}" r="{radius:g}"/>'
            f'<line stroke="#fff" stroke-width="3" x2="{SPOKE * radius:.1f}">'
            f"{turned('rotate', timed, turns)}</line></g>"
        )
    return "".join(parts)


def animated(name: str, timed: str, values: Iterable[str]) -> str:
    return f'<animate attributeName="{name}" {timed} values="{";".join(values)}"/>'


def turned(kind: str, timed: str, values: Iterable[str]) -> str:
    """A transform that goes from value to value."""
    form = f'attributeName="transform" type="{kind}" {timed}'
    return f'<animateTransform {form} values="{";".join(values)}"/>'
