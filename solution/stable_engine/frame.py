"""A frame: rods that balls connect, which keep their lengths together (SHAKE and RATTLE)."""

from __future__ import annotations

from math import hypot, inf
from typing import TYPE_CHECKING

from .cluster import Cluster
from .frame_parts import PARTS, Parts
from .network import HEAVY, Network, bodies_of
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
STEADY = 0.1  # share of an impulse; after parts, a whole substep must change it by less
FITTING = 3e-4  # share of a length; rods that are less off may pull with any force
STRONGEST = 10.0  # times what stops a frame: larger impulses strain it
HEATED = 2.0  # times the energy of a frame; impulses that would give it more strain it
GIVE = 0.1  # share of its pivot by which a rod gives way at first, if strained
MOST_GIVE = 1e4  # and at most
FASTEST = 4.0  # times the drive of a strained frame, up to which that may speed it up


class Frame(Cluster):
    """Rods that balls connect, and these balls."""

    def __init__(self, network: Network[Rod], world: World) -> None:
        super().__init__(bodies_of(network.rows), world)
        self.network = network
        self.rods = network.rows
        self.parts = Parts(self)
        masses = [ball.m for ball in self.balls]
        self.heaviest, self.lightest = max(masses), min(masses)  # kg
        self.is_uneven = self.heaviest > HEAVY * self.lightest
        is_braced = len(self.rods) > 2 * len(self.ends) - 3  # by more rods than keep its shape
        self.load = self.mass if is_braced else self.heaviest  # kg, that presses where it touches
        # whether rods lead from a ball back to it, if all static bodies count as one
        self.has_loop = len(self.rods) >= len(self.balls) + self.hangs
        self.most = inf  # kg px/s, of any rod's impulse in this substep
        # twice the energies, in kg px²/s²
        self.limit = -1.0  # of what it may have after this substep, or -1 for none
        self.lost = 0.0  # what it lost while it turned fast; it may gain it again
        self.work = 0.0  # what its rods added before the move
        self.gave_way = False  # whether its rods may take energy in this substep

    def keep_lengths(self, h: float, bias: float, soft: float) -> None:
        """Choose velocities with which all rods have their lengths after the move.

        `bias` is the share of a length error corrected per second; `soft` is how much more a rod
        gives way if a substep cannot be cut finely enough.
        """
        before = [rod.j for rod in self.rods]
        parts = self.parts
        self.gave_way = False
        if self.has_loop:
            self.find_most()
            if self.most < inf and not self.fits(LOOSE):
                self.gave_way, self.lost = True, 0.0
                self.limit, _ = self.look_back(h)
        if parts.count <= PARTS and self.find_impulses(h, bias):
            if parts.count == 1 or not self.has_jerked(before):
                parts.count = 1
                return
            self.return_to(before)
        if not (self.is_whole() and parts.go_along(h, bias)):
            parts.count = 1
            self.give_way(h, bias, soft)

    def find_impulses(self, h: float, bias: float, is_finest: bool = False) -> bool:
        """Find the impulses with which all rods keep their length in a move of h seconds (SHAKE).

        Return whether it found any: Newton's method fails if rods turn too far. In the finest
        parts, it may be slow.
        """
        last, slow = 0.0, 1.0 if is_finest else SLOW
        before = [rod.j for rod in self.rods]
        for left in range(PASSES - 1, -1, -1):
            off, turned = self.look_ahead(h, bias)
            if off <= EXACT:
                return True
            if turned < TURNED or left == 0 or (last and off > slow * last):
                break
            self.network.solve()
            self.take()
            if self.is_strained():
                break
            if off < NEAR:
                return True
            last = off
        self.return_to(before)
        return False

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
        """Solve for the impulses that remove all speed along the rods, and apply them."""
        for rod in self.rods:
            rod.ask(0.0)
        self.network.solve()
        if self.most < inf:
            most = self.strongest()
            if any([abs(rod.rhs) > most for rod in self.rods]):
                for rod in self.rods:
                    rod.ask(0.0)
                    rod.pivot += GIVE / rod.m
                self.network.solve()
        for rod in self.rods:
            rod.apply_impulse(rod.rhs)

    def take(self) -> None:
        """Apply the impulses in rhs, and add them to those before the move."""
        for rod in self.rods:
            rod.apply_impulse(rod.rhs)
            rod.j += rod.rhs

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

    def is_whole(self) -> bool:
        """Return whether all rods have nearly the right length."""
        return self.fits(TORN)

    def fits(self, share: float) -> bool:
        """Return whether all rods have the right length, but for less than a share of it."""
        return all([abs(rod.distance - rod.rest) < share * rod.rest for rod in self.rods])

    def give_way(self, h: float, bias: float, soft: float) -> None:
        """Choose velocities for a frame that cannot go in parts.

        It is torn, would need too many parts, or hangs on bodies of different velocities. It is
        soft if it turns too far for Newton's method, or if impulses would strain it. Its rods do no
        work.
        """
        is_soft = is_off = False
        before = [rod.j for rod in self.rods]
        free = self.look_back(h)[0] if self.has_loop else inf  # twice its energy without rods
        for left in range(PASSES - 1, -1, -1):
            off, turned = self.look_ahead(h, bias)
            if off <= EXACT:
                break
            is_soft = turned < LOST or (left == 0 and off > LOOSE)
            if self.limit < 0 and (is_soft or turned < GUARDED):
                self.limit, is_off = self.look_back(h)
            if is_soft:
                give = 2 * (soft - 1) / self.heaviest
                for rod in self.rods:
                    rod.pivot = 1 / rod.m + give
                    rod.rhs -= give * rod.j
            self.network.solve()
            self.take()
            if self.is_strained() or self.twice_energy() > HEATED * free:
                is_soft = True
                if self.limit < 0:
                    self.limit, _ = self.look_back(h)
                self.return_to(before)
                self.give_more(h, bias)
                break
            if is_soft or off < NEAR:
                break
        if self.limit >= 0:
            self.gave_way = self.gave_way or is_soft or is_off
            self.work = self.twice_energy() - self.limit

    def give_more(self, h: float, bias: float) -> None:
        """Choose velocities for a strained frame, softer and softer until it gains no energy."""
        before, give = [rod.j for rod in self.rods], GIVE
        while True:
            self.look_ahead(h, bias)
            self.soften(give)
            self.network.solve()
            self.take()
            if self.twice_energy() <= HEATED * self.limit or give > MOST_GIVE:
                break
            self.return_to(before)
            give *= 10

    def soften(self, give: float = GIVE) -> None:
        """Let rods give way by a share of their pivots. Where these fit, a matrix is singular."""
        for rod in self.rods:
            rod.pivot += give / rod.m
            rod.rhs -= give / rod.m * rod.j

    def find_most(self) -> None:
        """Find the largest impulse that a rod may have, by the speeds without those of rods.

        Rods in a loop may ask for the impossible, if bodies that they hang on move apart or lengths
        do not fit. At a dead point, the matrix is singular, and impulses would have no limit.
        """
        self.most = inf
        if self.drive() == 0 and self.fits(FITTING):
            return
        speeds = [(body, body.vx, body.vy) for body in self.ends]
        for rod in self.rods:
            rod.apply_impulse(-rod.j)
        self.most = self.strongest()
        for body, vx, vy in speeds:
            body.vx, body.vy = vx, vy

    def strongest(self) -> float:
        """Return the largest impulse (kg px/s) that the present speeds may call for."""
        vx, vy = self.velocity()
        fastest = max([hypot(body.vx - vx, body.vy - vy) for body in self.ends])
        return STRONGEST * self.mass * fastest

    def is_strained(self) -> bool:
        """Return whether any rod has a larger impulse than it may have."""
        return self.most < inf and any([abs(rod.j) > self.most for rod in self.rods])

    def drive(self) -> float:
        """Return how fast (px/s) any static body moves, seen from the first one it hangs on."""
        static = [body for body in self.ends if body.is_static]
        return max([hypot(b.vx - static[0].vx, b.vy - static[0].vy) for b in static], default=0.0)

    def look_back(self, h: float) -> tuple[float, bool]:
        """Return twice the energy (kg px²/s²) before the rods acted in this substep.

        A drive may add to that. Also return whether any rod has the wrong length, or would have
        without impulses: a rod that was torn or hit takes energy.
        """
        for rod in self.rods:
            rod.apply_impulse(-rod.j)
        errors = [(abs(r.distance - r.rest) + abs(r.speed()) * h, r.rest) for r in self.rods]
        energy = max(self.twice_energy(), self.mass * (FASTEST * self.drive()) ** 2)
        for rod in self.rods:
            rod.apply_impulse(rod.j)
        return energy, any([off > LOOSE * length for off, length in errors])

    def hold(self) -> None:
        """Remove all speed along the rods, at this instant."""
        for rod in self.rods:
            rod.measure()
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

    def take_back_stretching(self, h: float) -> None:
        """Remove all speed along the rods, in their present directions (RATTLE)."""
        for rod in self.rods:
            nx, ny = rod.nx, rod.ny
            rod.given += rod.j
            rod.measure()
            if nx * rod.nx + ny * rod.ny < SAME_DIRECTION:
                rod.j = 0.0
        starts_anew = self.gave_way and self.has_loop
        if self.parts.later:
            self.parts.end(h)
            starts_anew = not self.is_uneven
        if self.limit < 0:
            self.apply()
            self.lost = 0.0
        else:
            unchanged = self.twice_energy() - self.work
            self.apply()
            self.keep_energy(unchanged)
        for rod in self.rods:
            rod.given += rod.rhs
            if starts_anew:  # as a warm start, such impulses would throw what touches
                rod.j = 0.0

    def keep_energy(self, unchanged: float) -> None:
        """Scale speeds so that rods do no work: twice the energy is then `unchanged` (kg px²/s²).

        Some rods may take energy, see look_back. The balls never gain any.
        """
        most = self.limit + self.lost
        wanted = min(self.twice_energy() if self.gave_way else max(unchanged, 0.0), most)
        self.lost = most - wanted
        self.scale_speeds(wanted)
        self.limit = -1.0
