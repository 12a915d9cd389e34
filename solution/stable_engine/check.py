"""Name the effects that a scene needs and does not declare, or declares and does not use."""

from __future__ import annotations

from itertools import combinations
from math import hypot
from typing import TYPE_CHECKING

from .body import Body
from .joint import Joint
from .network import bodies_of, connect

if TYPE_CHECKING:
    from .world import World

FRAME = 1 / 60  # s
FAST = 20.0  # radii in a frame
SOON = 10.0  # s
MOST = 50  # balls
WEAK = 20.0  # units/s²
SHAKY = 0.15  # under a load of 3 g a ball turns by more than 1 rad in a substep


def missing(world: World, looked_at: list[Body]) -> dict[str, str]:
    """Return a sentence for each missing effect that these bodies need, by its name.

    A given friction above 0 needs Friction, and so does a body that turns or is a belt. A given
    restitution above 0 needs Bounce. Contacts are needed for friction, restitution,
    balls that fly at each other, and a static body that no joint is tied to. A ball that is too
    fast for Contacts needs Bullets. If no body can move, nothing is needed.
    """
    bodies = looked_at if len(world.members) > len(world.statics) else []
    reasons: dict[str, str] = {}
    for body in bodies:
        if body.friction_given and body.mu > 0:
            reasons.setdefault("Friction", f"{body!r} was given a friction of {body.mu:g}")
        is_belt = body.is_static and not body.is_kinematic and (body.vx or body.vy)
        if "Contacts" in world.effects and (body.w or is_belt):
            words = "turns" if body.w else "has a velocity, as a belt has,"
            reasons.setdefault("Friction", f"{body!r} {words} and would drag nothing along")
        if body.restitution_given and body.e > 0:
            reasons.setdefault("Bounce", f"{body!r} was given a restitution of {body.e:g}")
        if body.is_static and not body.joint_count:
            reasons.setdefault("Contacts", f"{body!r} is static, and bodies would pass through it")
        is_fast = not body.is_static and hypot(body.vx, body.vy) * FRAME > FAST * body.r
        if world.statics and is_fast:
            words = f"moves by more than {FAST:g} radii in {FRAME:.4f} s"
            reasons.setdefault("Bullets", f"{body!r} {words}")
    if "Friction" in reasons or "Bounce" in reasons:
        reasons.setdefault("Contacts", "without contacts, friction and restitution do nothing")
    if "Contacts" not in world.effects and "Contacts" not in reasons:
        for a, b in meetings(world, bodies)[:1]:
            reasons["Contacts"] = f"{a!r} and {b!r} would pass through each other"
    if "Contacts" not in world.effects:
        reasons.pop("Bullets", None)
    return {
        name: f"This scene calls for {name}(), which it does not declare: {reason}. "
        f"Declare it: World(effects=[..., {name}()])."
        for name, reason in reasons.items()
        if name not in world.effects
    }


def meetings(world: World, bodies: list[Body]) -> list[tuple[Body, Body]]:
    """Return pairs of free balls that overlap or fly at each other, of the first MOST in the world.

    Gravity accelerates both alike, so each flies straight as seen from the other. Balls on joints
    are left out.
    """
    new = set(bodies)
    free = [body for body in world.members if not (body.is_static or body.joint_count)][:MOST]
    pairs = [(a, b) for a, b in combinations(free, 2) if a in new or b in new]
    return [(a, b) for a, b in pairs if will_meet(a, b)]


def will_meet(a: Body, b: Body) -> bool:
    """Return whether two flying balls overlap, or will touch within SOON seconds."""
    x, y = a.x - b.x, a.y - b.y
    vx, vy = a.vx - b.vx, a.vy - b.vy
    speed2 = vx * vx + vy * vy
    nearest = max(0.0, min(SOON, -(x * vx + y * vy) / speed2)) if speed2 else 0.0  # s from now
    return hypot(x + vx * nearest, y + vy * nearest) < a.r + b.r


def odd_gravity(world: World) -> list[str]:
    """Return a sentence if the gravity is so weak for the unit that the scene may be in metres."""
    g = hypot(*world.g)
    if not 0 < g < WEAK * world.unit:
        return []
    return [
        f"A gravity of {g:g} is weak for lengths in pixels. "
        "Is the scene in metres? Then say how long a pixel is, as in World(unit=0.01)."
    ]


def unused(world: World) -> list[str]:
    """Return a sentence for each declared effect that the scene does not use."""
    return [
        f"This scene declares {name}(), but has no use for it. Leave it out, or add what it is for."
        for name, effect in world.effects.items()
        if not effect.is_used()
    ]


def overloaded_rods(world: World) -> list[str]:
    """Return a sentence if a light ball on rods carries more than the substeps can follow.

    All that rods connect to it, directly or through other balls, may hang on it. If rods turn, the
    heaviest one pulls as well.
    """
    rods: list[Joint] = getattr(world.effects.get("Rods"), "joints", [])
    h, g, turn = FRAME / 2 / world.substep_count, hypot(*world.g), whirl(rods)
    for frame in connect(rods):
        masses = [body.m for body in bodies_of(frame.rows)]
        load = sum(masses)
        pull = h * h * (g * load + turn * max(masses))
        for body, length in [(end, rod.rest) for rod in frame.rows for end in (rod.a, rod.b)]:
            if not body.is_static and pull > SHAKY * body.m * length:
                return [
                    f"{body!r} is on a rod with up to {load:g} kg: it may shake faster than "
                    "the substeps can follow. Take more substeps, or masses closer to each other."
                ]
    return []


def whirl(rods: list[Joint]) -> float:
    """Return the acceleration (px/s²) of the end of rods that turn, as if all were one chain."""
    length = speed = 0.0
    for rod in rods:
        a, b = rod.a, rod.b
        length += rod.rest
        speed += hypot(b.vx - a.vx, b.vy - a.vy)
    return speed * speed / length if length else 0.0
