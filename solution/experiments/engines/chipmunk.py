"""pymunk, which runs the C library Chipmunk."""

import math

import pymunk

from ..scenes import Ball
from .builder import Builder, State, Touch, is_moving

PASSES = 10  # its own choice
SLEEPY = 0.5  # s of rest until a body sleeps; by default none does
STATIC = pymunk.Body.STATIC


class Pymunk(Builder):
    """The same scene in pymunk.

    pymunk multiplies both frictions and both restitutions; the other engines take the root of the
    product of the frictions, and the smaller restitution. So each surface gets the root of its
    value. Friction then always agrees, and restitution does if both surfaces are alike.
    """

    name = "pymunk"

    def __init__(self, scene, passes=PASSES, substeps=1, slop=None):
        self.scene, self.substeps = scene, substeps
        self.space = pymunk.Space()
        self.space.gravity = scene.gravity
        self.space.iterations = passes
        if slop is not None:
            self.space.collision_slop = slop  # px, the overlap that it accepts
        if "Sleep" in scene.effects:
            self.space.sleep_time_threshold = SLEEPY
        self.space.damping = math.exp(-self.damping()[0])  # the share kept per second
        self.fill()

    def add(self, data):
        if is_moving(data):
            disc = 0.5 * data.radius**2  # px²: moment of inertia per kg
            body = pymunk.Body(data.mass, data.mass * disc)
        else:
            body = pymunk.Body(body_type=STATIC)
        body.position = data.pos
        if isinstance(data, Ball):
            shape = pymunk.Circle(body, data.radius)
            body.velocity, body.angular_velocity = data.vel, data.omega
        else:
            shape = pymunk.Poly.create_box(body, (2 * data.half[0], 2 * data.half[1]))
        surface = self.surface(data)
        shape.friction = math.sqrt(surface["friction"])
        shape.elasticity = math.sqrt(surface["restitution"])
        if "Contacts" not in self.scene.effects:
            shape.filter = pymunk.ShapeFilter(group=1)
        self.space.add(body, shape)
        return body

    def rod(self, a, b):
        self.tie(pymunk.PinJoint(self.bodies[a], self.bodies[b]))

    def spring(self, s):
        ends = self.bodies[s.a], self.bodies[s.b], (0, 0), (0, 0)
        self.tie(pymunk.DampedSpring(*ends, s.length, s.stiffness, s.damping))

    def tie(self, joint):
        """Add a joint. Its two bodies do not collide."""
        joint.collide_bodies = False
        self.space.add(joint)

    def step(self, dt):
        for _ in range(self.substeps):
            self.space.step(dt / self.substeps)

    def read(self, i):
        body = self.bodies[i]
        return State(*body.position, *body.velocity, body.angle, body.angular_velocity)

    def throw(self, i, velocity):
        self.bodies[i].velocity = tuple(velocity)

    def touches(self):
        found = {}

        def look(arbiter):
            points, ids = arbiter.contact_point_set, frozenset(b.id for b in arbiter.bodies)
            for point in points.points:
                place = (point.point_a + point.point_b) / 2
                share = arbiter.total_impulse.length / len(points.points)
                found[ids, place] = Touch(*place, *points.normal, share)

        for body in self.bodies:
            if body.body_type != STATIC:
                body.each_arbiter(look)
        return list(found.values())

    def lag(self, dt):
        """Return the lag: pymunk moves first and then changes velocities, half a step ahead."""
        return -dt / self.substeps / 2

    def asleep(self):
        return sum(body.is_sleeping for body in self.bodies)
