"""Parts of a substep, for frames whose rods turn too far in a whole one."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from .body import Body
from .cluster import squares

if TYPE_CHECKING:
    from .frame import Frame

PARTS = 4  # into which a substep is cut at first
MOST_PARTS = 64
MOST_WORK = 8192  # parts times rods, if masses differ much and that allows more parts

Velocity = tuple[float, float]


class Parts:
    """The parts of a frame's substep, so short that each rod turns only a little in each."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.count = 1  # into which the substep before was cut, if masses differ much
        # the velocities (px/s) of a substep in parts, during the move and after it
        self.later: list[tuple[Body, Velocity, Velocity]] = []

    def go_along(self, h: float, bias: float) -> bool:
        """Go in parts, as seen from the bodies the frame hangs on. Return whether it could.

        It cannot if these have different velocities: their work is not known.
        """
        frame = self.frame
        ways = {(body.vx, body.vy) for body in frame.ends if body.is_static}
        if not ways:
            return self.go_in_parts(h, bias)
        if len(ways) > 1:
            return False
        [(vx, vy)] = ways
        frame.change_speeds(-vx, -vy)
        done = self.go_in_parts(h, bias)
        frame.change_speeds(vx, vy)
        self.later = [
            (ball, (way[0] + vx, way[1] + vy), (after[0] + vx, after[1] + vy))
            for ball, way, after in self.later
        ]
        return done

    def go_in_parts(self, h: float, bias: float) -> bool:
        """Cut a substep into parts so short that each rod turns only a little in each.

        The balls get velocities that take them to their positions after all parts. In relax they
        get their velocities at that time, unless a contact was in the way. Return whether the parts
        are short enough; otherwise change nothing.
        """
        frame = self.frame
        before = [(ball, (ball.x, ball.y), (ball.vx, ball.vy)) for ball in frame.balls]
        impulses = [rod.j for rod in frame.rods]
        frame.return_to([0.0] * len(frame.rods))
        frame.fall(-h / 2)
        frame.hold()
        energy = frame.twice_energy() + frame.twice_potential()
        most = MOST_PARTS
        if frame.is_uneven and not self.flies_past(h):
            most = max(most, MOST_WORK // len(frame.rods))
        count, done = PARTS, 0  # equal parts done so far
        while done < count <= most:
            if self.move_on(h / count, bias, 2 * count > most):
                frame.scale_speeds(energy - frame.twice_potential())
                done += 1
            else:
                count, done = 2 * count, 2 * done
        frame.fall(-h / 2)
        for ball, (x, y), velocity in before:
            if count <= most:
                velocity = (ball.x - x) / h, (ball.y - y) / h
                self.later.append((ball, velocity, (ball.vx, ball.vy)))
            ball.x, ball.y = x, y
            ball.vx, ball.vy = velocity
        if count > most or not frame.hangs:  # for angular momentum, axes are those of the impulses
            for rod in frame.rods:
                rod.measure()
        if count > most:
            for rod, j in zip(frame.rods, impulses, strict=True):
                rod.j = j
        self.count = count if frame.is_uneven else 1
        return count <= most

    def move_on(self, part: float, bias: float, is_finest: bool) -> bool:
        """Move on by a part of a substep (s). If rods turn too far in it, return False and stay."""
        frame = self.frame
        frame.fall(part / 2)
        if not frame.find_impulses(part, bias, is_finest):
            frame.fall(-part / 2)
            return False
        for ball in frame.balls:
            ball.x += ball.vx * part
            ball.y += ball.vy * part
        frame.fall(part / 2)
        frame.hold()
        for rod in frame.rods:
            rod.j += rod.rhs
        return True

    def flies_past(self, h: float) -> bool:
        """Return whether an end of a rod moves further than its length within h seconds."""
        ends = [(rod.end_a, rod.end_b, rod.rest) for rod in self.frame.rods]
        return any([hypot(b.vx - a.vx, b.vy - a.vy) * h > length for a, b, length in ends])

    def end(self, h: float) -> None:
        """Give balls their velocities after all parts, and what contacts have added.

        The way in a straight line took that from other places: this turn is given back, but not to
        a torn frame, which may be so small that it would spin wildly.
        """
        frame = self.frame
        lost = 0.0  # kg px²/s, angular momentum
        for b, (way_x, way_y), (vx, vy) in self.later:
            dvx, dvy = b.vx - way_x, b.vy - way_y
            lost += b.m * h * (dvx * (way_y - vy) - dvy * (way_x - vx))
            b.vx, b.vy = vx + dvx, vy + dvy
        self.later = []
        if lost and not frame.hangs and frame.is_whole():
            x, y, _ = frame.spin(0.0, 0.0)
            change = lost / sum([b.m * squares(b.x - x, b.y - y) for b in frame.balls])  # rad/s
            for b in frame.balls:
                b.vx -= change * (b.y - y)
                b.vy += change * (b.x - x)
