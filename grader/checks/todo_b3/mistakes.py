"""Known mistakes in TODO B3, as models of the contacts found."""

import math
from collections.abc import Callable, Sequence
from itertools import product

from grader.checks.exact import Disc, Rect
from grader.checks.mistakes import Models, register
from grader.judge.explain.misconceptions import Kind, always, kinds

CELL = 48.0  # px; for another size, no mistake is named

Bounds = tuple[float, float, float, float]  # left, top, right, bottom in px
Cells = set[tuple[int, int]]
Pairs = list[tuple[int, int]]
Model = Callable[[Sequence[Disc], Sequence[Rect], Pairs], Pairs]

kinds["contacts"] = Kind(lambda balls, boxes, touching: touching)
kinds["comparison of all"] = Kind(always(False))


def grid(cells_of: Callable[[Bounds], Cells]) -> Model:
    """Return the model that compares only bodies sharing a cell of `cells_of`."""

    def model(balls: Sequence[Disc], boxes: Sequence[Rect], touching: Pairs) -> Pairs:
        within = [cells_of(each) for each in all_bounds(balls, boxes)]
        return [(a, b) for a, b in touching if within[a] & within[b]]

    return model


def all_bounds(balls: Sequence[Disc], boxes: Sequence[Rect]) -> list[Bounds]:
    """Return the bounds of each body, the balls first."""
    halves = [(x, y, r, r) for x, y, r in balls] + [tuple(each) for each in boxes]
    return [(x - hx, y - hy, x + hx, y + hy) for x, y, hx, hy in halves]


def number(coordinate: float) -> int:
    return math.floor(coordinate / CELL)


def cells(bounds: Bounds, beyond: int = 1) -> Cells:
    """Return all cells from the upper left corner to the lower right one."""
    left, top, right, bottom = map(number, bounds)
    return set(product(range(left, right + beyond), range(top, bottom + beyond)))


def cell_of_the_centre(bounds: Bounds) -> Cells:
    left, top, right, bottom = bounds
    return {(number((left + right) / 2), number((top + bottom) / 2))}


def cells_of_the_corners(bounds: Bounds) -> Cells:
    left, top, right, bottom = map(number, bounds)
    return set(product((left, right), (top, bottom)))


def cells_of_two_corners(bounds: Bounds) -> Cells:
    left, top, right, bottom = map(number, bounds)
    return {(left, top), (right, bottom)}


def once_per_cell(balls: Sequence[Disc], boxes: Sequence[Rect], touching: Pairs) -> Pairs:
    within = [cells(each) for each in all_bounds(balls, boxes)]
    return [(a, b) for a, b in touching for _ in within[a] & within[b]]


def only_the_nearest(balls: Sequence[Disc], boxes: Sequence[Rect], touching: Pairs) -> Pairs:
    places = [(each[0], each[1]) for each in (*balls, *boxes)]
    numbers = range(len(places))
    nearest_of = [
        min((n for n in numbers if n != own), key=lambda n: math.dist(places[own], places[n]))
        for own in numbers
        if len(places) > 1
    ]
    return [(a, b) for a, b in touching if nearest_of[a] == b or nearest_of[b] == a]


def only_of_balls(balls: Sequence[Disc], boxes: Sequence[Rect], touching: Pairs) -> Pairs:
    return [pair for pair in touching if max(pair) < len(balls)]


MODELS: Models = (
    ("forgets-the-last-cell", grid(lambda bounds: cells(bounds, beyond=0))),
    (
        "nothing-left-of-zero",
        grid(lambda bounds: {each for each in cells(bounds) if min(each) >= 0}),
    ),
    ("only-the-cell-of-the-centre", grid(cell_of_the_centre)),
    ("only-the-cells-of-the-corners", grid(cells_of_the_corners)),
    ("only-the-cells-of-the-corners", grid(cells_of_two_corners)),
    ("a-pair-once-per-cell", once_per_cell),
    ("only-the-nearest", only_the_nearest),
    ("a-pair-in-both-orders", lambda balls, boxes, touching: sorted([*touching, *touching])),
    ("boxes-are-left-out", only_of_balls),
    ("no-pair-that-touches", lambda balls, boxes, touching: []),
)
register("B3", "contacts", MODELS)
# Last, since it does not explain lost contacts: another mistake may.
register("B3", "comparison of all", [("compares-all-pairs", always(True))])
