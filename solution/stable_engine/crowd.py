"""Crowds: bodies that a program puts into each other, and balls whose centre is in another ball.

They are moved apart and get no speed by that. Contacts would push them apart as springs: balls in a
jam would store the push of many substeps, and be shot away by it.
"""

from math import copysign, sqrt

from .body import Body
from .contact import Contact, collide, leave_as_entered
from .detection import Detection
from .frame import Frame
from .order import in_same_place

PARTED = 0.3  # share of an overlap that a step takes from bodies in a crowd

Crowd = dict[Contact, bool]  # whether a program has put these bodies into each other


def gather_crowd(contacts: Detection, most: float, give: float) -> Crowd:
    """Return the contacts of a crowd. Balls that it is moved against in this step join it.

    Bodies that a program has put there press others deep into each other: these join as well. A
    contact leaves once it bears a load and is not deep any more, see is_deep.
    """
    crowd = contacts.crowd
    members = {body for c in crowd for body in (c.a, c.b) if body.m}
    put = {body for c in crowd if crowd[c] for body in (c.a, c.b) if body.m}
    for c in contacts.begun:
        if c.closing_speed() <= contacts.speculative_speed and not members.isdisjoint((c.a, c.b)):
            crowd.setdefault(c, False)
    for c in contacts.renewed if put else []:
        if is_deep(c, most, give) and not put.isdisjoint((c.a, c.b)):
            crowd[c] = True
    held = [c for c in contacts.touching if c in crowd]
    return {c: crowd[c] for c in held if c.jn == 0 or is_deep(c, most, give)}


def is_deep(c: Contact, most: float, give: float) -> bool:
    """Return whether bodies overlap by more than `most` px beyond what their load explains.

    Contacts would turn more overlap into more than the largest speed of a push.
    `give` is by how much (px) a contact gives way to an impulse of 1 px/s times its mass.
    """
    return c.gap + give * c.jn / c.mn < -most


def part_crowd(contacts: Detection, most: float) -> float:
    """Move bodies of the crowd apart, each pair by at most `most` px. Return the deepest overlap.

    They are moved and get no speed: impulses between many bodies at one position would leave
    some speed, which is energy from nothing. So balls turn about each other more slowly.
    """
    deepest = 0.0
    frame_of = contacts.rods.frame_of if contacts.rods else {}
    for group in contacts.groups:
        for same in in_same_place([c for c in group.sorted if c in contacts.crowd]):
            for c, (nx, ny, gap) in [(c, leave_as_entered(c, *collide(c.a, c.b))) for c in same]:
                a, b = c.a, c.b
                deepest = max(deepest, -gap)
                way = min(max(-PARTED * gap, 0.0), most)
                move_apart(c, nx * way, ny * way, frame_of)
                slip = (b.vy - a.vy) * nx - (b.vx - a.vx) * ny
                slower = -slip * way / (gap + a.r + b.r + way) if b.inv_mass else 0.0
                faster = 0.0
                if c.e:  # as if they had flown apart, which keeps their energy as well
                    away = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
                    square = away * away - slower * (2 * slip + slower)
                    faster = copysign(sqrt(max(square, 0.0)), away) - away
                dvx, dvy = (nx * faster - ny * slower) * c.mn, (ny * faster + nx * slower) * c.mn
                a.vx, a.vy = a.vx - dvx * a.inv_mass, a.vy - dvy * a.inv_mass
                b.vx, b.vy = b.vx + dvx * b.inv_mass, b.vy + dvy * b.inv_mass
                for body in (a, b):
                    if body.has_moved:  # what is jammed may sleep
                        body.still = 0.0
    return deepest


def move_apart(c: Contact, x: float, y: float, frame_of: dict[Body, Frame]) -> None:
    """Move A and B apart by (x, y) px in all, each with the balls on its rods.

    Rods that hang hold them, unless neither would move then.
    """
    alone = [([body], body.inv_mass) for body in (c.a, c.b)]
    moved = [*alone]
    frames = [frame_of.get(body) for body in (c.a, c.b)]
    for i, frame in enumerate(frames):
        if frame and frames[0] is not frames[1]:
            moved[i] = frame.balls, 0.0 if frame.hangs else 1 / frame.mass
    if not any([share for _, share in moved]):
        moved = alone
    (balls, light), (others, other_light) = moved
    for bodies, share in ((balls, -light), (others, other_light)):
        for body in bodies:
            body.x += x * share / (light + other_light)
            body.y += y * share / (light + other_light)
