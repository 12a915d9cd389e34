"""Strikes: fast hits without Bounce. What strikes stops dead, with all that is ahead of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .body import Body
from .contact import Contact, collide, leave_as_entered
from .hit import Hit, resolve_at_once
from .network import connected
from .order import balls_of
from .sweep import moment_of_touch

if TYPE_CHECKING:
    from .contacts import Contacts

AHEAD = 0.1  # cosine; a contact further aside takes no part in a strike
SHARE = 0.3  # of a strike; where less of it gets, passes are enough
ROUNDING = 1e-9  # of a share, or it would decide

Beside = dict[Body, list[Contact]]  # the contacts of each body


def stop_strikes(contacts: Contacts, dt: float) -> None:
    """Resolve fast hits of several bodies in the last step, of dt seconds, as if e were 0.

    Passes over contacts would hand on such a hit ball by ball, and leave some of its speed as a
    bounce. A hit of one pair stops in a pass. Hits of balls on joints are left to these.
    """
    fast, gap = contacts.slow_speed(dt), contacts.touching_gap
    struck = {c for c in contacts.begun if c.closing_speed() > fast and takes_part(c, gap)}
    if not struck:
        return
    beside: Beside = {}
    for c in contacts.touching:
        for body in (c.a, c.b):
            beside.setdefault(body, []).append(c)
    ago: dict[Body, float] = {}  # s, since a ball was hit
    hits = [c for c in contacts.touching if c in struck]
    for c in hits:
        since = moment_of_touch(c.a, c.b, dt)[0] or min(-c.gap / c.closing_speed(), dt)
        for body in (c.a, c.b):
            ago[body] = max(ago.get(body, 0.0), since)
    found = find_ahead(hits, beside, gap)
    near = [c for c in contacts.touching if c in found]
    at = {b: [c for c in beside[b] if c in found] for b in balls_of(near)}
    for group in connected(near, {c: at[c.a] + at.get(c.b, []) for c in near}):
        if len(group) > 1:
            balls = stop(group, ago)
            for ball in balls:
                contacts.note_impact(ball, ago[ball])
                measure(beside[ball])
            for ball in balls:
                if contacts.cores.stop_hit(ball, beside[ball], []):
                    measure(beside[ball])


def takes_part(c: Contact, touching_gap: float) -> bool:
    """Return whether two bodies touch, and neither is on a joint."""
    return c.gap <= touching_gap and not (c.a.joint_count or c.b.joint_count)


def find_ahead(struck: list[Contact], beside: Beside, touching_gap: float) -> set[Contact]:
    """Return the contacts of strikes, and those that balls are pressed into by them.

    Balls divide a strike between the contacts ahead of them, as far as much of it gets.
    """
    found = set(struck)
    shares: dict[tuple[Contact, Body], float] = {}  # by the body that is pressed
    ahead = [(c.b, c.nx, c.ny, 1.0) for c in struck] + [(c.a, -c.nx, -c.ny, 1.0) for c in struck]
    for body, nx, ny, share in ahead:
        on: list[tuple[Contact, float, float]] = []  # how far ahead, as a cosine, and which side
        for c in beside[body] if body.inv_mass else []:
            side = 1.0 if body is c.a else -1.0
            cosine = side * (c.nx * nx + c.ny * ny)
            if cosine > AHEAD and takes_part(c, touching_gap):
                on.append((c, cosine, side))
        whole = sum([cosine for _, cosine, _ in on])
        for c, cosine, side in on:
            part = share * cosine / whole
            other = c.b if body is c.a else c.a
            if part > shares.get((c, other), SHARE) + ROUNDING:
                shares[c, other] = part
                found.add(c)
                ahead.append((other, side * c.nx, side * c.ny, part))
    return found


def stop(group: list[Contact], ago: dict[Body, float]) -> list[Body]:
    """Move balls back to their touch, stop them there, and let them fly on. Return them.

    Along the way that each flew, angular momentum is kept. Those that were not hit themselves are
    pushed when the first one was.
    """
    balls = balls_of(group)
    first = max([ago[b] for b in balls if b in ago])
    for ball in balls:
        ago.setdefault(ball, first)
    fly(balls, ago, -1.0)
    measure(group)
    resolve_at_once([Hit(c, (0.0, 1.0)) for c in group], [])
    fly(balls, ago, 1.0)
    return balls


def fly(balls: list[Body], ago: dict[Body, float], way: float) -> None:
    """Let each ball fly straight for its time, or back if `way` is -1."""
    for ball in balls:
        seconds = way * ago[ball]
        ball.x += ball.vx * seconds
        ball.y += ball.vy * seconds
        ball.turn += ball.w * seconds


def measure(contacts: list[Contact]) -> None:
    """Find normals and gaps of contacts anew, but at corners that others cover."""
    for c in [c for c in contacts if c.gap < c.a.r]:
        c.nx, c.ny, c.gap = collide(c.a, c.b)
        if not c.b.r:
            c.nx, c.ny, c.gap = leave_as_entered(c, c.nx, c.ny, c.gap)
        c.found = c.gap
