"""Which pairs of bodies are near enough to look at."""

from itertools import combinations

from pygame import Vector2

from ..shapes import Circle

CELL = 48  # px, the side of a cell: a little more than the largest ball


def extent(body):
    """The corners of the upright box around a body, (low, high), in px."""
    shape = body.shape
    half = Vector2(shape.radius, shape.radius) if isinstance(shape, Circle) else shape.half
    return body.pos - half, body.pos + half


def near_pairs(bodies):
    """The pairs of bodies that may touch, each once.

    The plane is cut into square cells. A dictionary tells which bodies lie in which cell (x, y),
    with x and y whole numbers; a large body lies in many. Only bodies that share a cell may touch.
    """
    # TODO B3: look only at bodies that share a cell
    # Every pair, however far apart.
    return list(combinations(bodies, 2))
    # END TODO B3
