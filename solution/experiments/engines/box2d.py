"""Box2D 2.3 and Box2D v3.1, where they are installed: pip install Box2D pyb2d3."""

import math
import re

from ..scenes import Ball
from .builder import SUBSTEPS, Builder, State, Touch, is_moving

try:
    import Box2D
except ImportError:
    Box2D = None
try:
    import pyb2d3
except ImportError:
    pyb2d3 = None

PASSES = 8  # what Box2D 2.3 advises
ANY_SPEED = 1e9  # m/s; Box2D v3 would cut speeds at 400
PX_PER_M = 20.0  # Box2D works in metres, and is made for sizes of 0.1 to 10 m
POSITION_SHARE = 3 / 8  # of Box2D's passes: 8 for velocities and 3 for positions are advised
NO_COLLISIONS = -1  # a group of Box2D in which nothing collides


def spring_as_oscillator(scene, s):
    """Return the frequency (Hz) and the damping ratio of two bodies on a spring."""
    bodies = (scene.bodies[i] for i in (s.a, s.b))
    inverse = sum(1 / body.mass for body in bodies if isinstance(body, Ball) and body.mass)
    omega = math.sqrt(s.stiffness * inverse)
    ratio = s.damping * omega / (2 * s.stiffness) if s.stiffness else 0.0
    return omega / (2 * math.pi), ratio


class InMetres(Builder):
    """A scene in a Box2D, in metres. Subclasses give its functions the names of Box2D v3."""

    def metres(self, *lengths):
        return tuple(length / (PX_PER_M * self.scene.unit) for length in lengths)

    def state(self, position, velocity, angle, omega):
        """Return a state in px."""
        px = [PX_PER_M * self.scene.unit * float(number) for number in (*position, *velocity)]
        return State(*px, float(angle), float(omega))

    def read(self, i):
        body = self.bodies[i]
        velocity, spin = getattr(body, self.velocity), getattr(body, self.spin)
        return self.state(body.position, velocity, body.angle, spin)

    def throw(self, i, velocity):
        setattr(self.bodies[i], self.velocity, self.metres(*velocity))
        self.bodies[i].awake = True

    def add(self, data):
        effects, density = self.scene.effects, 0.0
        place = self.metres(*data.pos)
        if isinstance(data, Ball):
            (radius,) = self.metres(data.radius)
            shape = self.circle(radius=radius)
        else:
            shape = self.box(*self.metres(*data.half))
        if is_moving(data):
            density = data.mass / (math.pi * radius**2)
            damping = self.damping()
            body = self.create_dynamic_body(
                position=place,
                linear_velocity=self.metres(*data.vel),
                angular_velocity=data.omega,
                linear_damping=damping[0],
                angular_damping=damping[1],
                is_bullet=data.bullet and "Bullets" in effects,
                enable_sleep="Sleep" in effects,
            )
        else:
            body = self.create_static_body(position=place)
        group = 0 if "Contacts" in effects else NO_COLLISIONS
        self.create_shape(body, shape, density, group, **self.surface(data))
        return body

    def rod(self, a, b):
        length = math.dist(self.scene.bodies[a].pos, self.scene.bodies[b].pos)
        self.tie(self.bodies[a], self.bodies[b], *self.metres(length))

    def spring(self, s):
        """Add a spring by Box2D's values: its frequency and its damping ratio."""
        oscillator = spring_as_oscillator(self.scene, s)
        self.tie(self.bodies[s.a], self.bodies[s.b], *self.metres(s.length), *oscillator)


class Box2d(InMetres):
    """The same scene in Box2D 2.3.

    Its friction is that of the other engines. It takes the larger of two restitutions, which agrees
    if both surfaces are alike. It moves no body by more than 2 m, here 40 px, in a step.
    """

    name = "box2d"
    velocity, spin = "linearVelocity", "angularVelocity"  # what its bodies call them

    def __init__(self, scene, passes=PASSES, substeps=1):
        self.scene, self.passes, self.substeps = scene, passes, substeps
        self.world = Box2D.b2World(self.metres(*scene.gravity))
        self.create_static_body = self.world.CreateStaticBody
        self.fill()

    def circle(self, radius):
        return Box2D.b2CircleShape(radius=radius)

    def box(self, *half):
        return Box2D.b2PolygonShape(box=half)

    def create_dynamic_body(self, position, is_bullet, enable_sleep, **motion):
        camel = {re.sub("_.", lambda m: m[0][1].upper(), name): motion[name] for name in motion}
        flags = {"bullet": is_bullet, "allowSleep": enable_sleep}
        return self.world.CreateDynamicBody(position=position, **flags, **camel)

    def create_shape(self, body, shape, density, group, **surface):
        body.CreateFixture(shape=shape, density=density, groupIndex=group, **surface)

    def tie(self, a, b, length, hertz=0.0, ratio=0.0):
        """Join two centres. The two bodies do not collide."""
        ends = {"bodyA": a, "bodyB": b, "localAnchorA": (0, 0), "localAnchorB": (0, 0)}
        soft = {"frequencyHz": hertz, "dampingRatio": ratio}
        self.world.CreateDistanceJoint(**ends, **soft, length=length, collideConnected=False)

    def step(self, dt):
        positions = math.ceil(POSITION_SHARE * self.passes)
        for _ in range(self.substeps):
            self.world.Step(dt / self.substeps, self.passes, positions)

    def touches(self):
        """Return contacts without impulses, which Box2D gives to listeners only."""
        found = []
        for contact in self.world.contacts:
            if contact.touching:
                manifold = contact.worldManifold  # a copy, which must outlive its parts
                x, y, *_ = self.state(manifold.points[0], (0, 0), 0, 0)
                found.append(Touch(x, y, *manifold.normal, None))
        return found

    def asleep(self):
        return sum(not self.bodies[i].awake for i in self.scene.moving())


class Box2d3(InMetres):
    """The same scene in Box2D v3.1. It finds contacts once a step, for all substeps."""

    name = "box2d3"
    velocity, spin = "linear_velocity", "angular_velocity"  # what its bodies call them

    def __init__(self, scene, substeps=SUBSTEPS):
        self.scene, self.substeps = scene, substeps
        gravity = self.metres(*scene.gravity)
        self.world = pyb2d3.World(gravity=gravity, maximum_linear_speed=ANY_SPEED)
        self.circle, self.box = pyb2d3.circle, pyb2d3.box
        self.create_static_body = self.world.create_static_body
        self.create_dynamic_body = self.world.create_dynamic_body
        self.fill()

    def create_shape(self, body, shape, density, group, **surface):
        material = pyb2d3.surface_material(**surface)
        group = pyb2d3.make_filter(group_index=group)
        shape_def = pyb2d3.shape_def(density=density, material=material, filter=group)
        body.create_shape(shape_def, shape)

    def tie(self, a, b, length, hertz=0.0, ratio=0.0):
        """Join two centres. The two bodies do not collide."""
        soft = {"enable_spring": hertz > 0, "hertz": hertz, "damping_ratio": ratio}
        self.world.create_distance_joint(a, b, length=length, **soft)

    def step(self, dt):
        self.world.step(dt, self.substeps)
