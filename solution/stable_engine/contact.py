"""Contact points, and the geometry that finds them (the narrow phase)."""

from math import copysign, cos, sin, sqrt

from pygame import Vector2

from .body import Body
from .row import Row
from .shapes import Segment
from .soft import SAME_DIRECTION

PUSHER = 4.0  # the ratio of the masses of a kinematic body and a ball
RESTING_SPEED = 30.0  # 1/s, in units of the world; a slower impact does not bounce
GOLDEN_ANGLE = 2.399963  # rad
OPPOSITE = -0.5  # cosine; if a normal turns further, a centre has crossed a segment


class Contact:
    """Two bodies that touch. It persists while they do, so that its impulses can warm start.

    Centres `reach` px apart along the normal just touch. Impulses act on B as they are and on A
    reversed; friction turns both, each by its arm.
    """

    __slots__ = (
        *("a", "b", "nx", "ny", "found", "gap", "reach", "jn", "jt", "mn", "mt", "mu", "e"),
        *("arm_a", "arm_b", "spin_a", "spin_b", "last", "sunk", "place", "sorting", "ratio"),
    )

    def __init__(self, a: Body, b: Body) -> None:
        self.a = a  # always a ball with mass
        self.b = b
        self.nx = self.ny = 0.0  # unit normal from A to B; the tangent is (-ny, nx)
        self.found = 0.0  # px, the gap between them, negative when they overlap
        self.gap = 0.0  # px, the gap to solve for: for Bounce, separating bodies just touch
        self.reach = 0.0  # px
        self.jn = 0.0  # kg px/s, accumulated normal impulse, never negative
        self.jt = 0.0  # kg px/s, accumulated friction impulse
        self.last = 0.0  # kg px/s, jn after the substep before, in a pile of loads
        self.sunk = 0.0  # px, overlap that a steady load on springs explains
        self.place = 0.0, 0.0, 0.0  # in the order of solving, see give_places
        self.sorting = -1  # the last one that it was in, see put_in_order
        self.mn = self.ratio = 0.0  # kg, effective mass along the normal; ratio of the masses
        self.weigh()
        self.mt = 0.0  # kg, effective mass along the tangent, see set_arms
        self.mu = 0.0  # friction of the pair, filled in by Friction
        self.e = 0.0  # restitution of the pair, filled in by Bounce
        self.arm_a = self.arm_b = 0.0  # px, from the centres to where friction acts
        self.spin_a = self.spin_b = 0.0  # 1/(kg px), the spin that friction gives per impulse

    def weigh(self) -> None:
        """Take over the masses of A and B. A kinematic body counts as PUSHER balls."""
        a, b = self.a, self.b
        self.mn = 1 / (a.inv_mass + b.inv_mass)
        self.ratio = max(a.m / b.m, b.m / a.m) if b.m else PUSHER if b.is_kinematic else 1.0

    def set_arms(self, gap: float) -> None:
        """Let the arms of friction end at one point, amid a gap (px), or spin would be made."""
        a, b = self.a, self.b
        half = gap / 2 if b.inv_mass else 0.0
        self.arm_a, self.arm_b = arm_a, arm_b = a.r + half, b.r + half
        self.spin_a, self.spin_b = spin_a, spin_b = arm_a * a.inv_inertia, arm_b * b.inv_inertia
        self.mt = 1 / (a.inv_mass + b.inv_mass + (arm_a * spin_a + arm_b * spin_b))

    def __repr__(self) -> str:
        return f"Contact({self.a!r}, {self.b!r})"

    @property
    def normal(self) -> Vector2:
        """Return the unit normal from A to B."""
        return Vector2(self.nx, self.ny)

    @property
    def point(self) -> Vector2:
        """Return the point (px) on the rim of A, a ball, where it touches B."""
        a = self.a
        return Vector2(a.x + a.r * self.nx, a.y + a.r * self.ny)

    @property
    def impulse(self) -> float:
        """Return the impulse (kg px/s) of the latest substep, 0 or more: it pushes A and B apart.

        Divide it by the length of a substep for the force. It leaves out impulses of Bounce. In a
        step shorter than those before, it is a mean of both.
        """
        return self.jn

    @property
    def friction_impulse(self) -> float:
        """Return the friction impulse (kg px/s) of the latest substep.

        B gets it along the tangent, the normal turned clockwise on the screen; A the opposite.
        """
        return self.jt

    def closing_speed(self) -> float:
        """Return how fast A and B come together, in px/s."""
        a, b = self.a, self.b
        return (a.vx - b.vx) * self.nx + (a.vy - b.vy) * self.ny

    def push_apart(self, j: float) -> None:
        """Push A and B apart with an impulse j (kg px/s) along the normal."""
        Row(self.a, self.b, self.nx, self.ny).apply_impulse(j)


def collide(a: Body, b: Body) -> tuple[float, float, float]:
    """Return the unit normal from circle a to body b, in two numbers, and the gap in px.

    Each pair of concentric circles gets its own normal. With the same one for all, a heap of balls
    in one place would spread along one line.
    """
    if not b.r:
        return circle_box(a, b) if b.segment is None else circle_segment(a, b, b.segment)
    dx, dy = b.x - a.x, b.y - a.y
    distance = sqrt(dx * dx + dy * dy)
    if distance > 0:
        return dx / distance, dy / distance, distance - (a.r + b.r)
    angle = (7919 * a.id + b.id) * GOLDEN_ANGLE
    return cos(angle), sin(angle), -a.r - b.r


def turn_normals(contacts: list[Contact]) -> None:
    """Take over the normals of round bodies after the move, or their spin would not be kept.

    Balls that have passed each other, or are far apart, drop their impulses: taken back there,
    these would add energy. From a static body, a ball leaves the way it came. These are the circles
    of collide and the arms of set_arms, without the cost of calls.
    """
    for c in contacts:
        a, b = c.a, c.b
        if not b.r:
            continue
        dx, dy = b.x - a.x, b.y - a.y
        distance = sqrt(dx * dx + dy * dy)
        if distance == 0:
            continue
        nx, ny, radii = dx / distance, dy / distance, a.r + b.r
        same = nx * c.nx + ny * c.ny
        if same < SAME_DIRECTION and not b.inv_mass:
            continue
        if same < 0 or distance > 2 * radii:
            c.jn = c.jt = 0.0
        c.nx, c.ny = nx, ny
        if c.mu:
            half = (distance - radii) / 2 if b.inv_mass else 0.0
            c.arm_a, c.arm_b = arm_a, arm_b = a.r + half, b.r + half
            c.spin_a, c.spin_b = spin_a, spin_b = arm_a * a.inv_inertia, arm_b * b.inv_inertia
            c.mt = 1 / (a.inv_mass + b.inv_mass + (arm_a * spin_a + arm_b * spin_b))


def circle_box(a: Body, b: Body) -> tuple[float, float, float]:
    """Return normal and gap of a circle and a box. From inside, the nearest face counts."""
    x, y, hx, hy = a.x - b.x, a.y - b.y, b.hx, b.hy
    dx = hx - x if x > hx else -hx - x if x < -hx else 0.0  # max and min would cost calls
    dy = hy - y if y > hy else -hy - y if y < -hy else 0.0
    distance = sqrt(dx * dx + dy * dy)
    if distance > 0:
        return dx / distance, dy / distance, distance - a.r
    out_x, out_y = b.hx - abs(x), b.hy - abs(y)
    if out_y <= out_x:
        return 0.0, -copysign(1.0, y), -a.r - out_y
    return -copysign(1.0, x), 0.0, -a.r - out_x


def circle_segment(a: Body, b: Body, wall: Segment) -> tuple[float, float, float]:
    """Return normal and gap of a circle and a segment.

    With the centre on the axis, the normal is the axis turned clockwise on the screen.
    """
    x, y = a.x - b.x, a.y - b.y
    near_x, near_y = wall.nearest(x, y)
    dx, dy = near_x - x, near_y - y
    distance = sqrt(dx * dx + dy * dy)
    if distance > 0:
        return dx / distance, dy / distance, distance - wall.rim - a.r
    return -wall.uy, wall.ux, -wall.rim - a.r


def is_at_face(c: Contact) -> bool:
    """Return whether a ball is at a flat face of a box or segment, and not at a corner or end."""
    a, b = c.a, c.b
    return is_over_face(b, c.nx, c.ny, a.x - b.x, a.y - b.y)


def is_over_face(b: Body, nx: float, ny: float, x: float, y: float) -> bool:
    """Return whether a ball at (x, y) from the centre of B, with this normal, is at a flat face."""
    if b.segment is not None:
        return abs(x * b.segment.ux + y * b.segment.uy) <= b.segment.reach
    if b.r or (nx and ny):
        return False
    return abs(x) <= b.hx if ny else abs(y) <= b.hy


def leave_as_entered(c: Contact, nx: float, ny: float, gap: float) -> tuple[float, float, float]:
    """Return the normal and gap of two bodies that touched before, with normal (c.nx, c.ny).

    A circle whose centre is in a box leaves through the face by which it entered. By the nearest
    one, a ball pressed beyond the middle of a thin box would come out on the other side.
    """
    a, b = c.a, c.b
    if b.segment is not None:
        return leave_segment(c, b.segment, nx, ny, gap)
    if gap >= -a.r or b.r:
        return nx, ny, gap
    nx, ny = c.nx, c.ny
    if abs(nx) > abs(ny):
        nx, ny = copysign(1.0, nx), 0.0
    else:
        nx, ny = 0.0, copysign(1.0, ny)
    return nx, ny, (b.x - a.x) * nx + (b.y - a.y) * ny - b.hx * abs(nx) - b.hy * abs(ny) - a.r


def leave_segment(
    c: Contact, wall: Segment, nx: float, ny: float, gap: float
) -> tuple[float, float, float]:
    """Return the normal and gap of a ball and a segment that touched before.

    A centre that has crossed the segment, but not round its end, leaves on the side it came from.
    """
    a, b = c.a, c.b
    along = (a.x - b.x) * wall.ux + (a.y - b.y) * wall.uy
    if nx * c.nx + ny * c.ny > OPPOSITE or abs(along) >= wall.reach:
        return nx, ny, gap
    return -nx, -ny, -gap - 2 * (wall.rim + a.r)
