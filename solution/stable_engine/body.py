"""A body: a shape with a position, a velocity and a mass."""

from __future__ import annotations

from collections.abc import Iterable
from math import hypot, inf
from typing import TYPE_CHECKING

from pygame import Vector2

from .reading import read
from .shapes import Box, Circle, Segment
from .validate import finite, not_negative, number, pair, refuse, require

if TYPE_CHECKING:
    from .world import World

RESTITUTION, FRICTION = 0.3, 0.6  # where none is given
State = tuple[float, float, float, float]  # position (px) and velocity (px/s) of a body
LEAST = 1e-100  # kg and kg px²: far below, and far above its inverse, floats run out of range
UNKNOWN = inf, inf, inf  # px/s, of what was not slow at the last look of Sleep


class Body:
    """One rigid body.

    Mass 0 makes a static body, which never moves; a kinematic one moves by its own velocity, and
    no force changes that. A Box or Segment has no mass. A Segment stands where it was drawn unless
    pos names its middle; other shapes need a pos. Restitution and friction are for scenes
    that declare Bounce() and Friction(); there None means 0.3 and 0.6. A bullet is stopped where it
    first touches a static body, however fast it is. Raises ValueError when a value makes no sense.

    You can set pos, vel, angle, omega, mass, restitution, friction and bullet later on, and they
    count from the next step. A static body stays static. Do not set attributes that have no
    description here, such as x and vx: they are the engine's own.
    """

    __slots__ = (
        *("outline", "segment", "r", "hx", "hy", "m", "inv_mass", "inv_inertia"),
        *("e", "mu", "restitution_given", "friction_given"),
        *("x", "y", "vx", "vy", "turn", "w", "last_x", "last_y"),
        *("id", "world", "is_bullet", "is_kinematic", "idle", "island", "joint_count"),
        *("still", "calm", "kept", "kept_at", "touches", "has_moved", "jostled"),
        *("lag_x", "lag_y", "is_pressed", "is_fresh", "flown"),
    )

    def __init__(
        self,
        shape: Circle | Box | Segment,
        pos: Iterable[float] | None = None,
        mass: float = 0.0,
        restitution: float | None = None,
        friction: float | None = None,
        *,
        bullet: bool = False,
        kinematic: bool = False,
    ) -> None:
        not_negative("Body.mass", mass)
        require(mass > 0 or not bullet, "Body.mass", mass, "above 0 for a bullet")
        require(mass == 0 or not kinematic, "Body.mass", mass, "0 for a kinematic body")
        # what steps need comes first: it lies together in memory when compiled
        self.x = self.y = self.vx = self.vy = 0.0  # px, px/s
        self.w = self.turn = 0.0  # rad/s, and rad, clockwise on the screen
        self.lag_x = self.lag_y = 0.0  # px/s, what velocities lag behind positions in substeps
        self.is_pressed = False  # whether it is in contact, or on stiff springs, so nothing lags
        self.is_fresh = True  # whether it is new in the world, or moved by the program
        self.m = self.inv_mass = self.inv_inertia = 0.0  # see weigh
        self.id = 0  # from 1 up for a ball in a world, from -1 down for a static body
        self.idle = mass == 0  # static or asleep
        if not isinstance(shape, (Circle, Box, Segment)):
            refuse("Body.shape", shape, "a Circle, a Box or a Segment")
        self.segment = shape if isinstance(shape, Segment) else None
        self.r = shape.radius if isinstance(shape, Circle) else 0.0  # px
        self.hx, self.hy = shape.half  # px, half extents of the bounding box
        self.outline = shape
        rule = f"0 for a {type(shape).__name__}, which is always static"
        require(self.r > 0 or mass == 0, "Body.mass", mass, rule)
        if self.segment and pos is None:
            pos = self.segment.middle
        if pos is None:
            refuse("Body.pos", pos, "a pair of numbers, except for a Segment")
        self.x, self.y = pair("Body.pos", pos)  # px
        self.last_x, self.last_y = self.x, self.y  # px, when its contacts were last found
        self.e, self.mu = RESTITUTION, FRICTION
        self.restitution_given = self.friction_given = False
        self.world: World | None = None
        self.island: list[Body] = []  # the bodies it sleeps with
        self.joint_count = 0  # of the world's joints that are tied to it
        self.is_bullet = bullet
        self.is_kinematic = kinematic
        self.still = 0.0  # s, how long it has been slow and steady enough to sleep
        # s of free flight, if it was hit or stopped in the step before; else infinity
        self.flown = inf
        self.has_moved = False  # since the contacts near it were last found
        self.touches = 0  # the contacts of a ball with other balls
        self.jostled = False  # whether it has touched another ball since it was last fast
        self.calm = UNKNOWN  # px/s: vx, vy and the speed of its rim at the last look, if slow
        self.kept = 0.0  # s, how long it has stayed where it is
        self.kept_at = inf, 0.0, 0.0  # x, y and angle when that began
        # compiled attributes are fast if they are set before any method runs
        self.weigh(mass)
        if restitution is not None:
            self.restitution = restitution
        if friction is not None:
            self.friction = friction

    def __repr__(self) -> str:
        mass = f", mass={self.m:g}, vel=({self.vx:g}, {self.vy:g})" if self.m else ""
        return f"Body({self.shape!r}, ({self.x:g}, {self.y:g}){mass})"

    def weigh(self, mass: float) -> None:
        """Take over a mass, and the inertia of a disc of that mass."""
        mass = float(mass)
        twice = mass * (self.r * self.r)  # kg px², its inertia
        if mass and not (LEAST < mass < 1 / LEAST and LEAST < twice < 1 / LEAST):
            found = f"{mass:g} with a radius of {self.r:g}"
            require(False, "Body.mass", found, "neither so tiny nor so huge")
        self.m = mass  # kg
        self.inv_mass = 1 / mass if mass else 0.0  # 1/kg
        self.inv_inertia = 2 / twice if mass else 0.0  # 1/(kg px²)

    @property
    def shape(self) -> Circle | Box | Segment:
        """Return the shape, which stays the same."""
        return self.outline

    @property
    def radius(self) -> float:
        """Return the radius of a circle in px, 0 for other shapes."""
        return self.r

    @property
    def asleep(self) -> bool:
        """Return whether it sleeps: steps skip it until something wakes it."""
        return self.idle and self.inv_mass > 0

    @property
    def bullet(self) -> bool:
        """Return whether it is stopped where it first touches a static body, however fast it is.

        Setting it raises ValueError for a static body, and in a world without Bullets().
        """
        return self.is_bullet

    @bullet.setter
    def bullet(self, value: bool) -> None:
        require(not (value and self.is_static), "Body.mass", 0, "above 0 for a bullet")
        if self.world and bool(value) != self.is_bullet:
            bullets = self.world.need("Bullets", self)
            if value:
                bullets.add(self)
            else:
                bullets.forget(self)
        self.is_bullet = bool(value)
        self.moved()

    @property
    def is_static(self) -> bool:
        """Return whether no force can move this body: true of kinematic ones as well."""
        return self.inv_mass == 0

    @property
    def kinematic(self) -> bool:
        """Return whether it moves by its own velocity and spin, which no force changes."""
        return self.is_kinematic

    @property
    def mass(self) -> float:
        """Return the mass in kg, 0 for a static body, which stays static.

        Setting it wakes the body.
        """
        return self.m

    @mass.setter
    def mass(self, value: float) -> None:
        not_negative("Body.mass", value)
        rule = "0, as the body is static" if self.is_static else "above 0, as the body can move"
        require((value == 0) == self.is_static, "Body.mass", value, rule)
        if self.world and value < self.m:
            self.world.relieve({self: self.m - value})
        self.weigh(value)
        self.changed()

    @property
    def restitution(self) -> float:
        """Return the share of speed that an impact returns, 0 to 1. Setting it wakes the body."""
        return self.e

    @restitution.setter
    def restitution(self, value: float) -> None:
        self.e = number("Body.restitution", value, 0, 1, "a number from 0 to 1")
        self.restitution_given = True
        self.changed()

    @property
    def friction(self) -> float:
        """Return the friction of its surface, 0 or more. Setting it wakes the body."""
        return self.mu

    @friction.setter
    def friction(self, value: float) -> None:
        self.mu = not_negative("Body.friction", value)
        self.friction_given = True
        self.changed()

    @property
    def pos(self) -> Vector2:
        """Return the centre in px. Set both coordinates at once; this wakes the body."""
        return read("Body.pos", self.x, self.y)

    @pos.setter
    def pos(self, value: Iterable[float]) -> None:
        self.x, self.y = pair("Body.pos", value)
        if self.world:
            self.world.call("body_moved", self)
        self.moved()

    @property
    def vel(self) -> Vector2:
        """Return the velocity in px/s at `pos`. Set both parts at once; this wakes the body.

        Where contacts hold a ball, it is that of the last move, half a substep before.
        """
        return read("Body.vel", self.vx, self.vy)

    @vel.setter
    def vel(self, value: Iterable[float]) -> None:
        self.vx, self.vy = pair("Body.vel", value)
        self.moved()

    @property
    def angle(self) -> float:
        """Return how far it has turned, in rad, clockwise on the screen.

        Setting it raises ValueError for a Box or Segment, which never turns.
        """
        return self.turn

    @angle.setter
    def angle(self, value: float) -> None:
        self.turn = self.fitting_turn("Body.angle", value)

    @property
    def omega(self) -> float:
        """Return the spin in rad/s, clockwise on the screen. Setting it wakes the body.

        Setting it raises ValueError for a Box or Segment, which never turns.
        """
        return self.w

    @omega.setter
    def omega(self, value: float) -> None:
        self.w = self.fitting_turn("Body.omega", value)
        self.moved()

    def fitting_turn(self, name: str, value: float) -> float:
        """Return an angle or spin as a float. Raises ValueError if the body cannot have it."""
        turn, shape = finite(name, value), type(self.outline).__name__
        require(self.r > 0 or turn == 0, name, value, f"0, as a {shape} never turns")
        return turn

    def apply_impulse(self, impulse: Iterable[float], at: Iterable[float] | None = None) -> None:
        """Push with an impulse in kg px/s at a position in px: the centre, unless given.

        Raises ValueError for a static body, which no impulse moves.
        """
        jx, jy = pair("Body.apply_impulse's impulse", impulse)
        x, y = (self.x, self.y) if at is None else pair("Body.apply_impulse's at", at)
        require(not self.is_static, "Body.mass", 0, "above 0 for an impulse to move it")
        self.vx += jx * self.inv_mass
        self.vy += jy * self.inv_mass
        self.w += ((x - self.x) * jy - (y - self.y) * jx) * self.inv_inertia
        self.moved()

    def apply_force(self, force: Iterable[float], at: Iterable[float] | None = None) -> None:
        """Push with a force in kg px/s² during the whole next step, and no longer.

        `at` is a position in px, by default the centre. The torque about the centre is worked out
        now and stays the same. Forces add up. A force that should follow the position needs one
        substep and short steps. Raises ValueError for a static body, or one that is in no world.
        """
        fx, fy = pair("Body.apply_force's force", force)
        x, y = (self.x, self.y) if at is None else pair("Body.apply_force's at", at)
        self.push(fx, fy, (x - self.x) * fy - (y - self.y) * fx)

    def apply_torque(self, torque: float) -> None:
        """Turn with a torque in kg px²/s², clockwise on the screen, during the whole next step.

        Torques add up. Raises ValueError for a static body, or one that is in no world.
        """
        self.push(0.0, 0.0, finite("Body.apply_torque's torque", torque))

    def push(self, fx: float, fy: float, torque: float) -> None:
        """Add to the force and the torque that act on it in the next step."""
        require(not self.is_static, "Body.mass", 0, "above 0 for a force to move it")
        if self.world is None:
            refuse("Body.world", None, "a World: add the body before you push it")
        if not self.world.forces:
            self.world.update_hooks()
        before_x, before_y, before = self.world.forces.get(self, (0.0, 0.0, 0.0))
        self.world.forces[self] = before_x + fx, before_y + fy, before + torque
        self.still = self.kept = 0.0
        self.wake()

    def contains(self, point: Iterable[float]) -> bool:
        """Return whether a point (px) is in the body or on its edge."""
        x, y = pair("Body.contains's point", point)
        dx, dy = x - self.x, y - self.y
        if self.r:
            return hypot(dx, dy) <= self.r
        if self.segment is not None:
            x, y = self.segment.nearest(dx, dy)
            return hypot(dx - x, dy - y) <= self.segment.rim
        return abs(dx) <= self.hx and abs(dy) <= self.hy

    def wake(self) -> None:
        """Wake this body and those that sleep with it."""
        if self.island and self.world:
            self.world.call("wake", self.island)

    def moved(self) -> None:
        """Wake this body; if it is static, also wake bodies that rested on it or touch it now."""
        self.wake()
        self.is_pressed, self.is_fresh, self.jostled = False, True, False
        if self.world is None:
            return
        self.world.look_again(self, steers=not self.is_static)
        if self.is_static:
            self.world.call("static_moved", self)

    def changed(self) -> None:
        """Wake this body, and tell the effects of its new values."""
        self.wake()
        if self.world:
            self.world.look_again(self)
            self.world.call("body_changed", self)

    def check(self) -> None:
        """Raise ValueError naming the first number that is NaN or infinite."""
        pair("Body.pos", (self.x, self.y))
        pair("Body.vel", (self.vx, self.vy))
        finite("Body.angle", self.turn)
        finite("Body.omega", self.w)


def state_of(body: Body) -> State:
    """Return the position (px) and velocity (px/s) of a body."""
    return body.x, body.y, body.vx, body.vy
