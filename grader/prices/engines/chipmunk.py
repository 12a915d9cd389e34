"""pymunk under the lesson's names. What it does runs in C, of which no opcode tells.

pymunk multiplies what two surfaces have, where the lesson takes the root of the product of their
friction and the smaller restitution: each surface gets the root of its own, which is the same for
two alike.
"""

import math
from collections.abc import Sequence

import pymunk

Pair = Sequence[float]


class Circle:
    """A disc."""

    def __init__(self, radius: float) -> None:
        self.radius = radius


class Box:
    """A static rectangle by its half extents."""

    def __init__(self, half: Pair) -> None:
        self.half = half


class Body:
    """A body of pymunk's, whose numbers go by the lesson's names."""

    def __init__(
        self,
        shape: Circle | Box,
        pos: Pair,
        mass: float = 0.0,
        restitution: float = 0.3,
        friction: float = 0.6,
    ) -> None:
        self.shape = shape
        if isinstance(shape, Circle) and mass > 0:
            moment = mass * shape.radius**2 / 2
            self.body = pymunk.Body(mass, moment)
            self.inv_mass, self.inv_inertia = 1 / mass, 1 / moment
        else:
            self.body = pymunk.Body(body_type=pymunk.Body.STATIC)
            self.inv_mass = self.inv_inertia = 0.0
        self.body.position = pos[0], pos[1]
        self.outline: pymunk.Shape
        if isinstance(shape, Circle):
            self.outline = pymunk.Circle(self.body, shape.radius)
        else:
            size = 2 * shape.half[0], 2 * shape.half[1]
            self.outline = pymunk.Poly.create_box(self.body, size)
        self.outline.friction = math.sqrt(friction)
        self.outline.elasticity = math.sqrt(restitution)

    @property
    def pos(self) -> Pair:
        return self.body.position

    @pos.setter
    def pos(self, value: Pair) -> None:
        self.body.position = value[0], value[1]
        if self.body.space is not None:
            self.body.space.reindex_shapes_for_body(self.body)

    @property
    def vel(self) -> Pair:
        return self.body.velocity

    @vel.setter
    def vel(self, value: Pair) -> None:
        self.body.velocity = value[0], value[1]

    @property
    def angle(self) -> float:
        return self.body.angle

    @property
    def omega(self) -> float:
        return self.body.angular_velocity


class DistanceJoint:
    """A rod between two centres; what it holds does not collide."""

    def __init__(self, a: Body, b: Body) -> None:
        self.joint = pymunk.PinJoint(a.body, b.body)
        self.joint.collide_bodies = False


class World:
    """A space of pymunk's."""

    def __init__(
        self, gravity: Pair, linear_damping: float = 0.0, angular_damping: float = 0.0
    ) -> None:
        self.space = pymunk.Space()
        self.space.gravity = gravity[0], gravity[1]
        self.iterations = 10
        self.bodies: list[Body] = []
        self.joints: list[DistanceJoint] = []

    def add(self, body: Body) -> Body:
        self.bodies.append(body)
        self.space.add(body.body, body.outline)
        return body

    def step(self, dt: float) -> None:
        for each in self.joints:
            if each.joint not in self.space.constraints:
                self.space.add(each.joint)
        self.space.iterations = self.iterations
        self.space.step(dt)
