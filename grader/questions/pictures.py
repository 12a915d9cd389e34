"""Draw films of a scene: the bodies at some moments, and a click plays all of it.

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
    """The shape of a body: a disc where it has a radius, else a box."""

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
        """Return the bodies that move and are on no rod."""
        held = {end for rod in self.rods for end in rod}
        return [body for body in self.moving if body not in held]

    @property
    def moments(self) -> list[int]:
        """Return the rows that a picture shows, the last one among them."""
        last = len(self.rows) - 1
        return [round(last * (number + 1) / MOMENTS) for number in range(MOMENTS)]


def find_bounds(films: Sequence[Film]) -> tuple[float, float, float, float]:
    """Return what pictures of these films show: the scene, and what flies a little above it."""
    tops = [
        film.place(row, body)[1] - film.looks[body].radius
        for film in films
        for body in film.moving
        for row in film.moments
    ]
    top = max(MOST_ABOVE, min([USUAL_TOP, *tops]))
    return 0.0, top, 900.0, BOTTOM - top


def measure_difference(one: Film, other: Film) -> float:
    """Return how far two films are apart, px: at the centre or rim that differs most."""
    apart = [0.0]
    for row in one.moments:
        for body in one.moving:
            turned = abs(one.angle(row, body) - other.angle(row, body)) % (2 * math.pi)
            rim = min(turned, 2 * math.pi - turned) * one.looks[body].radius
            apart += [math.dist(one.place(row, body), other.place(row, body)), rim]
    return max(apart)


def draw_film(film: Film, name: str, alt: str, frame: tuple[float, float, float, float]) -> Picture:
    """Draw the film; `frame` is x, y, width and height of what is shown, px."""
    key = "film" + hash_film(name, film)
    parts = [draw_fixed(look) for look in film.looks if not look.moves]
    parts += [draw_trail(film, body) for body in film.moving]
    parts += [draw_rim(film, body) for body in film.loose]
    for number, row in enumerate(film.moments, 1):
        shown = "".join(draw_disc(film, row, body) for body in film.moving)
        rods = "".join(draw_rod(film, row, *ends) for ends in film.rods)
        parts.append(f'<g opacity="{(number / MOMENTS) ** 2:.2f}">{rods}{shown}</g>')
    parts.append(f'<g opacity="0">{show_on_click(key, film)}{animate_bodies(key, film)}</g>')
    box = " ".join(f"{each:g}" for each in frame)
    drawn = (
        f'<svg xmlns="http://www.w3.org/2000/svg" id="{key}" viewBox="{box}" role="img" '
        f'aria-label="{escape(alt)}">{"".join(parts)}</svg>'
    )
    return Picture(name, alt, drawn)


# As attributes, so that a picture looks the same alone, as in Moodle; a page's style goes before.
FIXED, BALL, LINE, RIM = "#b3b9c6", "#1f6fd6", "#5a6275", "#c25700"


def hash_film(name: str, film: Film) -> str:
    """Return a number that tells a picture's clicks from those of others; stable between runs."""
    return str(zlib.crc32(repr([name, *film.rows[-1]]).encode()))


def draw_fixed(look: Look) -> str:
    x, y = look.place
    if look.radius:
        return f'<circle class="fixed" fill="{FIXED}" cx="{x:g}" cy="{y:g}" r="{look.radius:g}"/>'
    wide, high = look.half
    return (
        f'<rect class="fixed" fill="{FIXED}" x="{x - wide:g}" y="{y - high:g}" '
        f'width="{2 * wide:g}" height="{2 * high:g}"/>'
    )


def draw_trail(film: Film, body: int) -> str:
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in (film.place(n, body) for n in rows_of(film)))
    look = f'fill="none" stroke="{BALL}" stroke-width="2" opacity="0.3"'
    return f'<polyline class="trail" {look} points="{points}"/>'


def draw_rim(film: Film, body: int) -> str:
    """Draw the way of a spoke's end: it shows on paper how a ball turns."""
    points = " ".join(
        f"{x:.1f},{y:.1f}" for x, y in (spoke_end(film, n, body) for n in rows_of(film))
    )
    return f'<polyline class="rim" fill="none" stroke="{RIM}" stroke-width="1" points="{points}"/>'


def spoke_end(film: Film, row: int, body: int) -> tuple[float, float]:
    """Return the end of the spoke of a ball."""
    (x, y), angle = film.place(row, body), film.angle(row, body)
    long = SPOKE * film.looks[body].radius
    return x + long * math.cos(angle), y + long * math.sin(angle)


def rows_of(film: Film) -> range:
    return range(len(film.rows))


def draw_disc(film: Film, row: int, body: int) -> str:
    (x, y), radius = film.place(row, body), film.looks[body].radius
    to_x, to_y = spoke_end(film, row, body)
    return (
        f'<circle class="ball" fill="{BALL}" cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}"/>'
        f'<line class="spoke" stroke="#fff" stroke-width="3" x1="{x:.1f}" y1="{y:.1f}" '
        f'x2="{to_x:.1f}" y2="{to_y:.1f}"/>'
    )


def draw_rod(film: Film, row: int, first: int, second: int) -> str:
    (x1, y1), (x2, y2) = film.place(row, first), film.place(row, second)
    ends = f'x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"'
    return f'<line class="rod" stroke="{LINE}" stroke-width="3" {ends}/>'


def show_on_click(key: str, film: Film) -> str:
    return f'<set attributeName="opacity" to="1" begin="{key}.click" dur="{film.seconds:g}s"/>'


def animate_bodies(key: str, film: Film) -> str:
    """Move each ball with its spoke, and rods, from row to row once the picture is clicked."""
    timed = f'begin="{key}.click" dur="{film.seconds:g}s"'
    rows = rows_of(film)
    parts = []
    for first, second in film.rods:
        moves = "".join(
            animate(name, timed, (f"{film.place(row, body)[axis]:.1f}" for row in rows))
            for number, body in enumerate((first, second), 1)
            for axis, name in enumerate((f"x{number}", f"y{number}"))
        )
        parts.append(f'<line stroke="{LINE}" stroke-width="3">{moves}</line>')
    for body in film.moving:
        radius = film.looks[body].radius
        places = (f"{x:.1f} {y:.1f}" for x, y in (film.place(row, body) for row in rows))
        turns = (f"{math.degrees(film.angle(row, body)):.0f}" for row in rows)
        parts.append(
            f'<g>{animate_shape("translate", timed, places)}<circle fill="{RIM}" r="{radius:g}"/>'
            f'<line stroke="#fff" stroke-width="3" x2="{SPOKE * radius:.1f}">'
            f"{animate_shape('rotate', timed, turns)}</line></g>"
        )
    return "".join(parts)


def animate(name: str, timed: str, values: Iterable[str]) -> str:
    return f'<animate attributeName="{name}" {timed} values="{";".join(values)}"/>'


def animate_shape(kind: str, timed: str, values: Iterable[str]) -> str:
    """Write a transform that goes from value to value."""
    form = f'attributeName="transform" type="{kind}" {timed}'
    return f'<animateTransform {form} values="{";".join(values)}"/>'
