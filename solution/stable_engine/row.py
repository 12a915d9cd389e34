"""Rows: what a network solves together, such as rods, springs and contacts."""

from .body import Body

FIRM = 1 + 1e-9  # times a pivot: with more rows than needed, a matrix has no inverse


class Row:
    """A constraint on the speed between two bodies along a normal, with an impulse along it."""

    __slots__ = ("arm_a", "arm_b", "end_a", "end_b", "m", "nx", "ny", "pivot", "rhs")

    def __init__(self, a: Body, b: Body, nx: float, ny: float) -> None:
        self.end_a = a
        self.end_b = b
        self.nx, self.ny = nx, ny  # unit normal, from A to B
        self.arm_a = self.arm_b = 0.0  # px, with which an impulse turns A and B
        self.pivot = self.rhs = 0.0  # see Network.solve
        self.weigh()

    def weigh(self) -> None:
        """Take over the masses of A and B."""
        self.m = 1 / (self.end_a.inv_mass + self.end_b.inv_mass)  # kg, effective mass

    def speed(self) -> float:
        """Return how fast B moves away from A, in px/s."""
        return (self.end_b.vx - self.end_a.vx) * self.nx + (self.end_b.vy - self.end_a.vy) * self.ny

    def ask(self, speed: float) -> None:
        """Ask for a speed (px/s) along it: set pivot and rhs for Network.solve."""
        self.pivot, self.rhs = FIRM / self.m, speed - self.speed()

    def apply_impulse(self, j: float) -> None:
        """Push B away from A by impulse j (kg px/s), and A by the opposite."""
        a, b = self.end_a, self.end_b
        px, py = self.nx * j, self.ny * j
        a.vx -= px * a.inv_mass
        a.vy -= py * a.inv_mass
        b.vx += px * b.inv_mass
        b.vy += py * b.inv_mass

    def take(self, j: float) -> None:
        """Apply an impulse j (kg px/s), and count it where its sum is needed."""
        self.apply_impulse(j)
