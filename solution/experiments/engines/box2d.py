"""Box2D 2.3 and Box2D v3.1, where they are installed: pip install Box2D pyb2d3."""

import math

from ..scenes import Ball
from .builder import SUBSTEPS, Builder, State, Touch

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
PX_PER_M = 20.0  # Box2D reckons in metres, and is made for sizes of 0.1 to 10 m
POSITION_SHARE = 3 / 8  # of Box2D's passes: it advises 8 for velocities and 3 for positions
NO_COLLISIONS = -1  # a group of Box2D's in which nothing collides


def spring_as_oscillator(scene, s):
    """Return the frequency (Hz) and the damping ratio of the two bodies on a spring."""
    bodies = (scene.bodies[i] for i in (s.a, s.b))
    inverse = sum(1 / body.mass for body in bodies if isinstance(body, Ball) and body.mass)
    omega = math.sqrt(s.stiffness * inverse)
    ratio = s.damping * omega / (2 * s.stiffness) if s.stiffness else 0.0
    return omega / (2 * math.pi), ratio


class Box2d(Builder):
    """The same scene in Box2D, in metres.

    Its friction is that of the other engines. Of two restitutions it takes the larger one: the same
    where both surfaces are alike. It moves no body by more than 2 m, here 40 px, in a step.
    """

    name = "box2d"

    def __init__(self, scene, passes=PASSES, substeps=1):
        self.scene, self.passes, self.substeps = scene, passes, substeps
        self.metre = PX_PER_M * scene.unit
        gravity = (scene.gravity[0] / self.metre, scene.gravity[1] / self.metre)
        self.world = Box2D.b2World(gravity)
        self.fill()

    def add(self, data):
        effects = self.scene.effects
        metres = {"position": (data.pos[0] / self.metre, data.pos[1] / self.metre)}
        surface = {
            "friction": data.friction if "Friction" in effects else 0.0,
            "restitution": data.restitution if "Bounce" in effects else 0.0,
            "groupIndex": 0 if "Contacts" in effects else NO_COLLISIONS,
        }
        if not isinstance(data, Ball):
            half = (data.half[0] / self.metre, data.half[1] / self.metre)
            body = self.world.CreateStaticBody(**metres)
            body.CreateFixture(shape=Box2D.b2PolygonShape(box=half), **surface)
            return body
        shape = Box2D.b2CircleShape(radius=data.radius / self.metre)
        if data.mass == 0:
            body = self.world.CreateStaticBody(**metres)
            body.CreateFixture(shape=shape, **surface)
            return body
        damping = self.scene.damping if "Damping" in effects else (0.0, 0.0)
        body = self.world.CreateDynamicBody(
            **metres,
            linearVelocity=(data.vel[0] / self.metre, data.vel[1] / self.metre),
            angularVelocity=data.omega,
            linearDamping=damping[0],
            angularDamping=damping[1],
            bullet=data.bullet and "Bullets" in effects,
            allowSleep="Sleep" in effects,
        )
        area = math.pi * (data.radius / self.metre) ** 2
        body.CreateFixture(shape=shape, density=data.mass / area, **surface)
        return body

    def rod(self, a, b):
        self.tie(a, b, math.dist(self.scene.bodies[a].pos, self.scene.bodies[b].pos))

    def spring(self, s):
        """Add a spring by its frequency and its damping ratio, as Box2D has them."""
        hertz, ratio = spring_as_oscillator(self.scene, s)
        self.tie(s.a, s.b, s.length, frequencyHz=hertz, dampingRatio=ratio)

    def tie(self, a, b, length, **soft):
        """Join two centres. The two bodies do not collide."""
        ends = {"bodyA": self.bodies[a], "bodyB": self.bodies[b], "collideConnected": False}
        anchors = {"localAnchorA": (0, 0), "localAnchorB": (0, 0)}
        self.world.CreateDistanceJoint(**ends, **anchors, length=length / self.metre, **soft)

    def step(self, dt):
        positions = math.ceil(POSITION_SHARE * self.passes)
        for _ in range(self.substeps):
            self.world.Step(dt / self.substeps, self.passes, positions)

    def read(self, i):
        body = self.bodies[i]
        (x, y), (vx, vy) = body.position, body.linearVelocity
        metres = [self.metre * number for number in (x, y, vx, vy)]
        return State(*metres, body.angle, body.angularVelocity)

    def throw(self, i, velocity):
        self.bodies[i].linearVelocity = [number / self.metre for number in velocity]
        self.bodies[i].awake = True

    def touches(self):
        """Return contacts without impulses, which Box2D gives to listeners only."""
        found = []
        for contact in self.world.contacts:
            if contact.touching:
                manifold = contact.worldManifold  # a copy: its parts end with it
                (x, y), (nx, ny) = manifold.points[0], manifold.normal
                found.append(Touch(self.metre * x, self.metre * y, nx, ny, None))
        return found

    def asleep(self):
        return sum(not self.bodies[i].awake for i in self.scene.moving())


class Box2d3(Builder):
    """The same scene in Box2D v3.1, in metres. It finds contacts once a step, for all substeps."""

    name = "box2d3"

    def __init__(self, scene, substeps=SUBSTEPS):
        self.scene, self.substeps = scene, substeps
        self.metre = PX_PER_M * scene.unit
        gravity = tuple(g / self.metre for g in scene.gravity)
        self.world = pyb2d3.World(gravity=gravity, maximum_linear_speed=ANY_SPEED)
        self.fill()

    def add(self, data):
        effects = self.scene.effects
        material = pyb2d3.surface_material(
            friction=data.friction if "Friction" in effects else 0.0,
            restitution=data.restitution if "Bounce" in effects else 0.0,
        )
        group = 0 if "Contacts" in effects else NO_COLLISIONS
        surface = {"material": material, "filter": pyb2d3.make_filter(group_index=group)}
        place = tuple(x / self.metre for x in data.pos)
        if isinstance(data, Ball):
            shape = pyb2d3.circle(radius=data.radius / self.metre)
        else:
            shape = pyb2d3.box(*(half / self.metre for half in data.half))
        if not isinstance(data, Ball) or data.mass == 0:
            body = self.world.create_static_body(position=place)
            body.create_shape(pyb2d3.shape_def(**surface), shape)
            return body
        damping = self.scene.damping if "Damping" in effects else (0.0, 0.0)
        body = self.world.create_dynamic_body(
            position=place,
            linear_velocity=tuple(v / self.metre for v in data.vel),
            angular_velocity=data.omega,
            linear_damping=damping[0],
            angular_damping=damping[1],
            is_bullet=data.bullet and "Bullets" in effects,
            enable_sleep="Sleep" in effects,
        )
        area = math.pi * (data.radius / self.metre) ** 2
        body.create_shape(pyb2d3.shape_def(density=data.mass / area, **surface), shape)
        return body

    def rod(self, a, b):
        self.tie(a, b, math.dist(self.scene.bodies[a].pos, self.scene.bodies[b].pos))

    def spring(self, s):
        hertz, ratio = spring_as_oscillator(self.scene, s)
        self.tie(s.a, s.b, s.length, enable_spring=True, hertz=hertz, damping_ratio=ratio)

    def tie(self, a, b, length, **soft):
        """Join two centres. The two bodies do not collide."""
        ends = self.bodies[a], self.bodies[b]
        self.world.create_distance_joint(*ends, length=length / self.metre, **soft)

    def step(self, dt):
        self.world.step(dt, self.substeps)

    def read(self, i):
        body = self.bodies[i]
        (x, y), (vx, vy) = body.position, body.linear_velocity
        metres = [self.metre * float(number) for number in (x, y, vx, vy)]
        return State(*metres, float(body.angle), float(body.angular_velocity))

    def throw(self, i, velocity):
        self.bodies[i].linear_velocity = tuple(v / self.metre for v in velocity)
        self.bodies[i].awake = True
