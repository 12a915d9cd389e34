"""The lab scene as the lesson describes it, part by part, for the mini engine and for pymunk.

A program may draw a ball's colour after its radius in any way. So only the first radius from a
random.Random is known.
"""

import math
import random
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from grader.judge.decode import Pair
from grader.judge.lab import Lab, Thing
from grader.protocol import BodyValue, Played, Rng, ShapeValue, SpaceBody, SpaceValue

SEED = 12
RADII = range(10, 23)  # px

Bounds = tuple[float, float, float, float]  # left, least y, right, largest y; px
Disc = tuple[float, ...]  # x, y, radius in px and mass in kg, rounded


class Part(NamedTuple):
    """A body of the scene."""

    pos: Pair
    shape: tuple[float, ...]  # half extents of a box, or the radius of a disc; px
    mass: float = 0.0  # kg, 0 = static
    restitution: float = 0.3
    friction: float = 0.6
    moment: float | None = None  # kg px²; None if a TODO decides it, or for a static body

    @property
    def named(self) -> str:
        x, y = self.pos
        size = " x ".join(f"{2 * half:g}" for half in self.shape)
        what = f"disc {size} px wide" if len(self.shape) == 1 else f"box of {size} px"
        return f"a {'moving' if self.mass else 'static'} {what} at ({x:g}, {y:g})"


HOOK, ROD = (700.0, 90.0), 140.0  # px; the pendulum's hook, and its length
FIXED = [
    Part((450, 580), (450, 20)),  # the floor
    Part((-20, 300), (20, 300)),
    Part((920, 300), (20, 300)),
    Part((200, 260), (150, 10)),  # the ledge
    *(Part((375 + 60 * number, 400), (8,)) for number in range(5)),  # pegs
    Part(HOOK, (6,)),
]
BOB = Part((840, 90), (24,), 6, 0.2)
LEFT, TOP, RIGHT, BOTTOM = range(4)  # of Bounds; y grows down
FAR, ROUND = 10_000.0, 10.0  # px
FACES = {  # px, the sides of a segment that replaces a box
    FIXED[0]: {TOP: (557, 563), LEFT: (-FAR, 3), RIGHT: (897, FAR)},
    FIXED[1]: {RIGHT: (-3, 3), TOP: (-FAR, 3), BOTTOM: (557, FAR)},
    FIXED[2]: {LEFT: (897, 903), TOP: (-FAR, 3), BOTTOM: (557, FAR)},
    FIXED[3]: {
        TOP: (247, 253),
        LEFT: (50 - ROUND, 50 + ROUND),
        RIGHT: (350 - ROUND, 350 + ROUND),
    },
}
STACK = [
    Part((760, 542 - 36 * level), (25, 18), 1.8, 0.1, 0.7, 1.8 * (50**2 + 36**2) / 12)
    for level in range(4)
]
BALLS = [(120.0 + 70 * number, 60.0 + 40 * (number % 3)) for number in range(8)]


def ball(pos: Pair, radius: float) -> Part:
    return Part(pos, (radius,), radius**2 / 100, 0.4)


def first_radius(seed: int) -> int:
    """Return the radius that random.Random(seed) draws for the first ball, px."""
    return random.Random(seed).randint(10, 22)


def turning_as_a_disc(part: Part) -> Part:
    """Add the moment of a full disc, if the engine and not the student computes it."""
    return part._replace(moment=part.mass * part.shape[0] ** 2 / 2) if part.mass else part


def want_parts(lab: Lab, found: list[Part], expected: list[Part], seed: int) -> None:
    """Insist on these parts, on eight balls drawn by this seed, and on nothing else."""
    first = first_radius(seed)
    for part in expected:
        want_part(lab, found, part)
    own_moments = any(part.moment for part in expected if len(part.shape) == 1)
    for number, pos in enumerate(BALLS):
        radius = next(
            (p.shape[0] for p in found if len(p.shape) == 1 and is_close(p.pos, pos)), 0.0
        )
        allowed = [first] if number == 0 else RADII
        lab.want(
            radius in allowed,
            f"a ball at ({pos[0]:g}, {pos[1]:g}) with a radius "
            + (f"of {first} px, the first number drawn" if number == 0 else "of 10 to 22 px"),
            f"a radius of {radius:g} px" if radius else "no ball there",
            f"random.Random({seed}) draws the balls, each radius before its colour.",
        )
        like = ball(pos, radius)
        want_part(lab, found, turning_as_a_disc(like) if own_moments else like)
    count = len(expected) + len(BALLS)
    lab.want(len(found) == count, f"{count} bodies and static shapes", f"{len(found)}")


def want_part(lab: Lab, found: list[Part], part: Part) -> None:
    """Insist on one part, and name the number that differs."""
    here = [p for p in found if is_close(p.pos, part.pos) and len(p.shape) == len(part.shape)]
    lab.want(bool(here), part.named, "nothing there")
    pairs = [
        *((name, getattr(part, name), getattr(here[0], name)) for name in NUMBERS),
        *(("half size", a, b) for a, b in zip(part.shape, here[0].shape, strict=True)),
    ]
    for name, wanted, got in pairs:
        if wanted is not None and (got is None or not math.isclose(wanted, got, rel_tol=1e-6)):
            lab.fail(
                f"{part.named}, its {name} {wanted:.9g}",
                f"its {name} is {'infinite' if got is None else f'{got:.9g}'}",
            )


NUMBERS = ("mass", "restitution", "friction", "moment")


def is_close(first: Sequence[float], second: Sequence[float]) -> bool:
    return math.dist(first, second) <= 1e-6


# ---------------------------------------------------------------- what the submission has


def world_parts(lab: Lab, seed: int) -> list[Part]:
    """Return the bodies that make_world(random.Random(12)) puts into the mini engine's world."""
    world = lab.thing(lab.call("make_world", Rng(seed)), "a World")
    bodies = lab.items(lab.get(world, "bodies"), "the bodies of the scene")
    return [body_part(lab, lab.body(each)) for each in bodies]


def body_part(lab: Lab, body: BodyValue) -> Part:
    names = ["restitution", "friction", *([] if body.radius else ["shape.half"])]
    restitution, friction, *half = lab.gets((Thing(body.ref), name) for name in names)
    shape = lab.pair(half[0], "half") if half else (body.radius,)
    still = (*body.vel, body.angle, body.omega) == (0, 0, 0, 0)
    lab.want(still, "a scene in which nothing moves yet", "a body with speed or spin")
    return Part(
        (body.pos.x, body.pos.y),
        shape,
        1 / body.inv_mass if body.inv_mass else 0.0,
        lab.number(restitution, "the restitution"),
        lab.number(friction, "the friction"),
        1 / body.inv_inertia if body.inv_inertia else None,
    )


def pymunk_scene(lab: Lab, seed: int) -> tuple[SpaceValue, list[Thing]]:
    """Return the space that make_space(random.Random(12)) returns, and the boxes of its stack."""
    items = lab.items(lab.call("make_space", Rng(seed)), "what make_space returns")
    lab.want(len(items) == 2, "make_space to return (space, stack)", f"{len(items)} things")
    boxes = lab.items(items[1], "the stack")
    return lab.space(items[0]), [lab.thing(box, "a box of the stack") for box in boxes]


def space_parts(space: SpaceValue) -> list[Part]:
    """Return each moving body with its shape, and each static shape but a disc at the hook."""
    parts = [part for body in space.bodies for part in shapes_of(body)]
    return [part for part in parts if part.mass or not is_close(part.pos, HOOK)]


def shapes_of(body: SpaceBody) -> list[Part]:
    parts = []
    for shape in body.shapes:
        left, low, right, high = shape.box
        place: Pair = ((left + right) / 2, (low + high) / 2)
        size: tuple[float, ...] = ((right - left) / 2, (high - low) / 2)
        rest = (shape.elasticity, shape.friction, body.moment)
        if shape.kind == "Circle":
            size = (shape.radius,)
        elif shape.radius and not body.mass:  # a segment, or a polygon with a rim
            place, size = as_box(shape.box) or (place, size)
        parts.append(Part(place, size, body.mass, *rest))
    return parts


def as_box(bounds: Bounds) -> tuple[Pair, tuple[float, ...]] | None:
    """Return position and half extents of the box that a segment replaces, or None.

    A segment may be thick and rounded if its surface matches the box's.
    """
    for part, faces in FACES.items():
        if all(low <= bounds[side] <= high for side, (low, high) in faces.items()):
            return part.pos, part.shape
    return None


def moving_discs(played: Played) -> list[Disc]:
    """Return the discs that can move when a program ends, in order."""
    discs = []
    for body in played.bodies:
        match body:
            case BodyValue(inv_mass=inverse) if inverse:
                discs.append(round_disc(body.pos, body.radius, 1 / inverse))
            case SpaceBody(shapes=[ShapeValue(kind="Circle") as shape, *_]) if body.mass:
                discs.append(round_disc(body.pos, shape.radius, body.mass))
    return sorted(discs)


def first_discs(lab: Lab, seed: int) -> list[Disc]:
    """Return the discs that can move in make_world(random.Random(seed))."""
    return sorted(disc_of(part) for part in world_parts(lab, seed) if part.mass)


def disc_of(part: Part) -> Disc:
    return round_disc(part.pos, part.shape[0], part.mass)


def round_disc(pos: Iterable[float], radius: float, mass: float) -> Disc:
    return tuple(round(number, 6) for number in (*pos, radius, mass))


def is_a_ball(x: float, y: float, radius: float, mass: float) -> bool:
    """Return whether some random number gives a ball of this radius and mass, anywhere."""
    return radius in RADII and math.isclose(mass, radius**2 / 100, rel_tol=1e-6)
