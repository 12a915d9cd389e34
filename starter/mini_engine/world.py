"""The world and its step."""

import math
from itertools import combinations

from pygame import Vector2

from .constants import ITERATIONS
from .contacts import collide
from .solver import solve_friction, solve_normal, target_speed
from .validate import require


class World:
    """Bodies, joints and the contacts of the latest step.

    gravity in px/s²; the dampings are rates per second (0 means none).
    """

    def __init__(self, gravity=(0, 980), linear_damping=0.05, angular_damping=0.3):
        self.gravity = Vector2(gravity)
        self.linear_damping = linear_damping  # 1/s
        self.angular_damping = angular_damping  # 1/s
        self.bodies = []
        self.joints = []
        self.contacts = []
        self.iterations = ITERATIONS  # passes of the solver per step
        require(self.gravity.length() < math.inf, "World.gravity", self.gravity, "finite")
        for field in ("linear_damping", "angular_damping"):
            rate = getattr(self, field)
            require(0 <= rate < math.inf, f"World.{field}", rate, "a finite number, 0 or more")

    def add(self, body):
        """Add a body and return it. Raises ValueError when it is here already."""
        require(body not in self.bodies, "World.add's body", f"here already, at {body.pos}", "new")
        self.bodies.append(body)
        return body

    def moving_bodies(self):
        """The bodies that forces act on."""
        return [body for body in self.bodies if not body.is_static]

    def step(self, dt):
        """Advance by dt seconds. Raises ValueError on a bad dt or a body with NaN or infinity."""
        require(0 < dt < math.inf, "World.step's dt", dt, "a finite number of seconds above 0")
        for body in self.bodies:
            body.check()

        # 1 forces
        self.apply_forces(dt)
        # 2 detect
        self.contacts = self.find_contacts()
        # 3 solve
        self.solve(dt)
        # 4 move
        self.move(dt)

    def apply_forces(self, dt):
        """Let moving bodies fall faster, and damp them."""
        for body in self.moving_bodies():
            body.vel += self.gravity * dt
        if self.linear_damping or self.angular_damping:
            self.apply_damping(dt)

    def apply_damping(self, dt):
        """Slow moving bodies down: each second keeps the share exp(-rate), whatever the step."""
        # TODO 5: damp by a rate per second
        # These numbers ignore both rates and dt.
        keep_vel = 0.99
        keep_omega = 0.99
        # END TODO 5
        for body in self.moving_bodies():
            body.vel *= keep_vel
            body.omega *= keep_omega

    def find_contacts(self):
        """The contacts of all bodies where they are now. Two that do not move need none."""
        moving = set(self.moving_bodies())
        found = [collide(a, b) for a, b in self.pairs() if a in moving or b in moving]
        return [contact for contact in found if contact is not None]

    def pairs(self):
        """The pairs of bodies to look at: every body with every other one."""
        return combinations(self.bodies, 2)

    def solve(self, dt):
        """Find velocities that suit every contact and joint, pass by pass."""
        for contact in self.contacts:
            contact.target = target_speed(contact, dt)
        for joint in self.joints:
            joint.prepare(dt)
        for _ in range(self.iterations):
            for contact in self.contacts:
                self.solve_contact(contact, dt)
            for joint in self.joints:
                joint.solve()

    def solve_contact(self, c, dt):
        """One pass over c: the normal impulse, then friction. c.target has dt in it already."""
        solve_normal(c)
        if c.a.friction > 0 and c.b.friction > 0:
            solve_friction(c)

    def move(self, dt):
        """Move and turn bodies with their new velocities (semi-implicit Euler)."""
        for body in self.moving_bodies():
            body.pos += body.vel * dt
            body.angle += body.omega * dt
