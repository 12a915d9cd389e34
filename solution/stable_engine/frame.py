"""A frame: rods that balls connect, which keep their lengths together (SHAKE and RATTLE)."""

from __future__ import annotations

from math import hypot, sqrt
from typing import TYPE_CHECKING

from .body import Body
from .network import HEAVY, Network
from .row import FIRM
from .soft import SAME_DIRECTION

if TYPE_CHECKING:
    from .rods import Rod
    from .world import World

PASSES = 6  # of Newton's method: a length is no linear function of the speeds
NEAR = 1e-6  # share of a length; after a smaller error, one pass is left
EXACT = 1e-10  # share of a length, at which the passes end
SLOW = 0.03  # share of an error that a pass may leave; more means that rods turn too far
TURNED = 0.97  # cosine of what a rod may turn by in a substep or part
TORN = 0.02  # share of a length; a rod that is further off is torn
LOOSE = 0.003  # share of a length; above this error the frame is soft
GUARDED = 0.9  # cosine; if a rod turns further in a substep, none may gain energy
LOST = 0.8  # cosine; if a rod turns further in a substep, Newton's method fails
PARTS = 4  # into which a substep is cut at first
STEADY = 0.1  # share of an impulse; after parts, a whole substep must change it by less
MOST_PARTS = 64
MOST_WORK = 8192  # parts times rods, if masses differ much and that allows more parts

Velocity = tuple[float, float]


class Frame:
    """Rods that balls connect."""

    def __init__(self, network: Network[Rod], world: World) -> None:
        self.world = world
        self.network = network
        self.rods = network.rows
        ends = dict.fromkeys([body for rod in self.rods for body in (rod.end_a, rod.end_b)])
        self.balls = [body for body in ends if not body.is_static]
        self.ends = list(ends)
        self.hangs = len(self.balls) < len(ends)
        masses = [ball.m for ball in self.balls]
        self.mass = sum(masses)  # kg
        self.heaviest, self.lightest = max(masses), min(masses)  # kg
        self.is_uneven = self.heaviest > HEAVY * self.lightest
        is_braced = len(self.rods) > 2 * len(ends) - 3  # by more rods than keep its shape
        self.load = self.mass if is_braced else self.heaviest  # kg, that presses where it touches
        # twice the energies, in kg px²/s²
        self.limit = -1.0  # of what it may have after this substep, or -1 for none
        self.lost = 0.0  # what it lost while it turned fast; it may gain it again
        self.work = 0.0  # what its rods added before the move
        self.parts = 1  # into which the substep before was cut, if masses differ much
        self.is_off = False  # whether a rod was torn or hit before this substep
        self.gave_way = False  # whether its rods may take energy in this substep
        # the velocities (px/s) of a substep in parts, during the move and after it
        self.later: list[tuple[Body, Velocity, Velocity]] = []

    def keep_lengths(self, h: float, bias: float, soft: float) -> None:
        """Choose velocities with which all rods have their lengths after the move.

        `bias` is the share of a length error corrected per second; `soft` is how much more a rod
        gives way if a substep cannot be cut finely enough.
        """
        before = [rod.j for rod in self.rods]
        if self.parts <= PARTS and self.find_impulses(h, bias):
            if self.parts == 1 or not self.has_jerked(before):
                self.parts = 1
                return
            self.return_to(before)
        if not (self.is_whole() and self.go_along(h, bias)):
            self.parts = 1
            self.give_way(h, bias, soft)

    def find_impulses(self, h: float, bias: float, slow: float = SLOW) -> bool:
        """Find the impulses with which all rods keep their length in a move of h seconds (SHAKE).

        Return whether it found any: Newton's method fails if rods turn too far. A pass may leave
        the share `slow` of the error.
        """
        last = 0.0
        before = [rod.j for rod in self.rods]
        for left in range(PASSES - 1, -1, -1):
            off, turned = self.look_ahead(h, bias)
            if off <= EXACT:
                return True
            if turned < TURNED or left == 0 or (last and off > slow * last):
                break
            self.apply()
            for rod in self.rods:
                rod.j += rod.rhs
            if off < NEAR:
                return True
            last = off
        self.return_to(before)
        return False

    def return_to(self, impulses: list[float]) -> None:
        """Take back what the rods' impulses have changed since they were these."""
        for rod, j in zip(self.rods, impulses, strict=True):
            rod.apply_impulse(j - rod.j)
            rod.j = j

    def has_jerked(self, before: list[float]) -> bool:
        """Return whether impulses are far from those of the substep before."""
        most = max([max(abs(rod.j), abs(j)) for rod, j in zip(self.rods, before, strict=True)])
        changes = [abs(rod.j - j) for rod, j in zip(self.rods, before, strict=True)]
        return max(changes) > STEADY * most

    def go_along(self, h: float, bias: float) -> bool:
        """Go in parts, as seen from the bodies it hangs on. Return whether it could.

        It cannot if these have different velocities: their work is not known.
        """
        ways = {(body.vx, body.vy) for body in self.ends if body.is_static}
        if not ways:
            return self.go_in_parts(h, bias)
        if len(ways) > 1:
            return False
        [(vx, vy)] = ways
        self.change_speeds(-vx, -vy)
        done = self.go_in_parts(h, bias)
        self.change_speeds(vx, vy)
        self.later = [
            (ball, (way[0] + vx, way[1] + vy), (after[0] + vx, after[1] + vy))
            for ball, way, after in self.later
        ]
        return done

    def change_speeds(self, vx: float, vy: float) -> None:
        """Change the velocities of its balls, and of the bodies it hangs on."""
        for body in self.ends:
            body.vx += vx
            body.vy += vy

    def go_in_parts(self, h: float, bias: float) -> bool:
        """Cut a substep into parts so short that each rod turns only a little in each.

        The balls get velocities that take them to their positions after all parts. In relax they
        get their velocities at that time, unless a contact was in the way. Return whether the parts
        are short enough; otherwise change nothing.
        """
        before = [(ball, (ball.x, ball.y), (ball.vx, ball.vy)) for ball in self.balls]
        impulses = [rod.j for rod in self.rods]
        self.return_to([0.0] * len(self.rods))
        self.fall(-h / 2)
        self.hold()
        energy = self.twice_energy() + self.twice_potential()
        most = MOST_PARTS
        if self.is_uneven and not self.flies_past(h):
            most = max(most, MOST_WORK // len(self.rods))
        count, done = PARTS, 0  # equal parts done so far
        while done < count <= most:
            if self.move_on(h / count, bias, SLOW if 2 * count <= most else 1.0):
                self.scale_speeds(energy - self.twice_potential())
                done += 1
            else:
                count, done = 2 * count, 2 * done
        self.fall(-h / 2)
        for ball, (x, y), velocity in before:
            if count <= most:
                velocity = (ball.x - x) / h, (ball.y - y) / h
                self.later.append((ball, velocity, (ball.vx, ball.vy)))
            ball.x, ball.y = x, y
            ball.vx, ball.vy = velocity
        if count > most or not self.hangs:  # for angular momentum, axes are those of the impulses
            for rod in self.rods:
                rod.measure()
        if count > most:
            for rod, j in zip(self.rods, impulses, strict=True):
                rod.j = j
        self.parts = count if self.is_uneven else 1
        return count <= most

    def move_on(self, part: float, bias: float, slow: float) -> bool:
        """Move on by a part of a substep (s). If rods turn too far in it, return False and stay."""
        self.fall(part / 2)
        if not self.find_impulses(part, bias, slow):
            self.fall(-part / 2)
            return False
        for ball in self.balls:
            ball.x += ball.vx * part
            ball.y += ball.vy * part
        self.fall(part / 2)
        self.hold()
        for rod in self.rods:
            rod.j += rod.rhs
        return True

    def flies_past(self, h: float) -> bool:
        """Return whether an end of a rod moves further than its length within h seconds."""
        ends = [(rod.end_a, rod.end_b, rod.rest) for rod in self.rods]
        return any([hypot(b.vx - a.vx, b.vy - a.vy) * h > length for a, b, length in ends])

    def fall(self, seconds: float) -> None:
        """Add the speed of a fall of so many seconds."""
        gx, gy = self.world.g
        for ball in self.balls:
            ball.vx += gx * seconds
            ball.vy += gy * seconds

    def velocity(self) -> tuple[float, float]:
        """Return the velocity (px/s) of the centre of mass, 0 if it hangs on a static body."""
        if self.hangs:
            return 0.0, 0.0
        momentum_x = sum([ball.m * ball.vx for ball in self.balls])
        return momentum_x / self.mass, sum([ball.m * ball.vy for ball in self.balls]) / self.mass

    def twice_potential(self) -> float:
        """Return twice the potential energy (kg px²/s²), 0 if all fall together."""
        gx, gy = self.world.g
        return -sum([2 * b.m * (gx * b.x + gy * b.y) for b in self.balls]) if self.hangs else 0.0

    def scale_speeds(self, wanted: float) -> None:
        """Scale the speeds about the centre of mass until twice_energy is `wanted` (kg px²/s²).

        A frame that flies freely keeps its spin, and so its angular momentum: the rest is scaled.
        """
        vx, vy = self.velocity()
        x, y, spin = (0.0, 0.0, 0.0) if self.hangs else self.spin(vx, vy)
        turning = [(vx - spin * (b.y - y), vy + spin * (b.x - x)) for b in self.balls]
        pairs = list(zip(self.balls, turning, strict=True))
        fixed = sum([b.m * squares(tx - vx, ty - vy) for b, (tx, ty) in pairs])
        energy = sum([b.m * squares(b.vx - tx, b.vy - ty) for b, (tx, ty) in pairs])
        if energy > 0 and wanted != energy + fixed:
            share = sqrt(max(wanted - fixed, 0.0) / energy)
            for b, (tx, ty) in pairs:
                b.vx = tx + (b.vx - tx) * share
                b.vy = ty + (b.vy - ty) * share

    def spin(self, vx: float, vy: float) -> tuple[float, float, float]:
        """Return the centre of mass (px), and the spin (rad/s) about it by angular momentum."""
        x = sum([b.m * b.x for b in self.balls]) / self.mass
        y = sum([b.m * b.y for b in self.balls]) / self.mass
        turn = sum([b.m * ((b.x - x) * (b.vy - vy) - (b.y - y) * (b.vx - vx)) for b in self.balls])
        inertia = sum([b.m * squares(b.x - x, b.y - y) for b in self.balls])
        return x, y, turn / inertia if inertia else 0.0

    def twice_energy(self) -> float:
        """Return twice the kinetic energy (kg px²/s²), relative to the centre of mass."""
        vx, vy = self.velocity()
        return sum([b.m * squares(b.vx - vx, b.vy - vy) for b in self.balls])

    def twice_energy_before(self, h: float) -> float:
        """Return twice the energy (kg px²/s²) before the rods acted in this substep.

        Also note whether any rod has the wrong length, or would have without impulses: a rod that
        was torn or hit takes energy.
        """
        self.is_off = False
        for rod in self.rods:
            rod.apply_impulse(-rod.j)
        for rod in self.rods:
            off = abs(rod.distance - rod.rest) + abs(rod.speed()) * h
            self.is_off = self.is_off or off > LOOSE * rod.rest
        energy = self.twice_energy()
        for rod in self.rods:
            rod.apply_impulse(rod.j)
        return energy

    def keep_energy(self, unchanged: float) -> None:
        """Scale speeds so that rods do no work: twice the energy is then `unchanged` (kg px²/s²).

        Some rods may take energy, see twice_energy_before. The balls never gain any.
        """
        most = self.limit + self.lost
        wanted = min(self.twice_energy() if self.gave_way else max(unchanged, 0.0), most)
        self.lost = most - wanted
        self.scale_speeds(wanted)
        self.limit = -1.0

    def is_whole(self) -> bool:
        """Return whether all rods have nearly the right length."""
        return all([abs(rod.distance - rod.rest) < TORN * rod.rest for rod in self.rods])

    def give_way(self, h: float, bias: float, soft: float) -> None:
        """Choose velocities for a frame that cannot go in parts.

        It is torn, would need too many parts, or hangs on bodies of different velocities. It is
        soft if it turns too far for Newton's method. Its rods do no work.
        """
        is_soft = False
        for left in range(PASSES - 1, -1, -1):
            off, turned = self.look_ahead(h, bias)
            if off <= EXACT:
                break
            is_soft = turned < LOST or (left == 0 and off > LOOSE)
            if self.limit < 0 and (is_soft or turned < GUARDED):
                self.limit = self.twice_energy_before(h)
            if is_soft:
                give = 2 * (soft - 1) / self.heaviest
                for rod in self.rods:
                    rod.pivot = 1 / rod.m + give
                    rod.rhs -= give * rod.j
            self.apply()
            for rod in self.rods:
                rod.j += rod.rhs
            if is_soft or off < NEAR:
                break
        if self.limit >= 0:
            self.gave_way = is_soft or self.is_off
            self.work = self.twice_energy() - self.limit

    def look_ahead(self, h: float, bias: float) -> tuple[float, float]:
        """Set the changes of speed that keep each rod's length in the move to come.

        Return the largest error (share of its length) and the cosine of the largest turn.
        """
        off, turned = 0.0, 1.0
        for rod in self.rods:
            a, b = rod.end_a, rod.end_b
            dx, dy = rod.dx + (b.vx - a.vx) * h, rod.dy + (b.vy - a.vy) * h
            ahead, distance = dx * rod.nx + dy * rod.ny, hypot(dx, dy)
            turn = ahead / distance if distance else -1.0  # a cosine
            speed = (distance - rod.distance) / h if ahead > 0 else rod.speed()
            speed += bias * (rod.distance - rod.rest)
            rod.pivot, rod.rhs = FIRM / rod.m, -speed / turn if turn > LOST else -speed
            off = max(off, abs(speed) * h / rod.rest)
            turned = min(turned, turn)
        return off, turned

    def apply(self) -> None:
        """Solve for the impulses that change all rods' speeds by rhs, and apply them."""
        self.network.solve()
        for rod in self.rods:
            rod.apply_impulse(rod.rhs)

    def hold(self) -> None:
        """Remove all speed along the rods, at this instant."""
        for rod in self.rods:
            rod.measure()
            rod.ask(0.0)
        self.apply()

    def hold_lags(self) -> None:
        """Remove what would stretch rods from the changes of velocities."""
        before = [(body, body.vx, body.vy) for body in self.ends]
        for body in self.ends:
            body.vx, body.vy = body.lag_x, body.lag_y
        self.hold()
        for body, vx, vy in before:
            body.lag_x, body.lag_y = body.vx, body.vy
            body.vx, body.vy = vx, vy

    def end_parts(self, h: float) -> None:
        """Give balls their velocities after all parts, and what contacts have added.

        The way in a straight line took that from other places: this turn is given back, but not to
        a torn frame, which may be so small that it would spin wildly.
        """
        lost = 0.0  # kg px²/s, angular momentum
        for b, (way_x, way_y), (vx, vy) in self.later:
            dvx, dvy = b.vx - way_x, b.vy - way_y
            lost += b.m * h * (dvx * (way_y - vy) - dvy * (way_x - vx))
            b.vx, b.vy = vx + dvx, vy + dvy
        self.later = []
        if lost and not self.hangs and self.is_whole():
            x, y, _ = self.spin(0.0, 0.0)
            change = lost / sum([b.m * squares(b.x - x, b.y - y) for b in self.balls])  # rad/s
            for b in self.balls:
                b.vx -= change * (b.y - y)
                b.vy += change * (b.x - x)

    def take_back_stretching(self, h: float) -> None:
        """Remove all speed along the rods, in their present directions (RATTLE)."""
        for rod in self.rods:
            nx, ny = rod.nx, rod.ny
            rod.given += rod.j
            rod.measure()
            if nx * rod.nx + ny * rod.ny < SAME_DIRECTION:
                rod.j = 0.0
        if self.later:
            self.end_parts(h)
        for rod in self.rods:
            rod.ask(0.0)
        if self.limit < 0:
            self.apply()
            self.lost = 0.0
        else:
            unchanged = self.twice_energy() - self.work
            self.apply()
            self.keep_energy(unchanged)
        for rod in self.rods:
            rod.given += rod.rhs


def squares(x: float, y: float) -> float:
    """Return the sum of two squares. Powers are rounded in other ways in another unit."""
    return x * x + y * y
