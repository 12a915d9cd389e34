"""One builder per engine. All of them then answer to the same few names. Box2D is optional.

An engine here is a scene in motion: step(dt) advances it by dt seconds, read(i) tells the state of
the body at place i of the scene's list, and contacts() and asleep() count. For a person at the
window throw(i, velocity) gives a body another velocity, drop(ball) adds one, and touches() tells
where bodies touch.
"""

import math
import time
from collections import namedtuple

import pymunk
from pygame import Vector2

try:
    import Box2D
except ImportError:  # python -m pip install Box2D
    Box2D = None

import mini_engine
import stable_engine
from mini_engine import ITERATIONS

from .scenes import Ball

SUBSTEPS = 4  # of the stable engine
PASSES = 10  # of pymunk, its own choice
BOX2D_PASSES = 8  # what it advises
SLEEPY = 0.5  # s of rest until pymunk has a body sleep; without it, none does

STATIC = pymunk.Body.STATIC
State = namedtuple("State", "x y vx vy angle omega")
# A contact: its point, the unit normal towards the second body, and the impulse (kg px/s) of the
# latest step along it; None where the engine does not tell.
Touch = namedtuple("Touch", "x y nx ny impulse")


class Builder:
    """The base of all builders. Each one has add(data), rod(a, b) and spring(s)."""

    def fill(self):
        """Add the scene's bodies, and the rods and springs that it declares."""
        scene = self.scene
        self.bodies = [self.add(data) for data in scene.bodies]
        for a, b in scene.rods if "Rods" in scene.effects else ():
            self.rod(a, b)
        for spring in scene.springs if "Springs" in scene.effects else ():
            self.spring(spring)

    def drop(self, ball):
        """Add a ball while the scene runs."""
        self.scene.bodies.append(ball)
        self.bodies.append(self.add(ball))

    def lag(self, dt):
        """Return how long (s) velocities lag behind positions: half a step of Euler's."""
        return dt / self.substeps / 2

    def spent(self):
        """Return the processor time (s) that counts as this engine's."""
        return time.thread_time()

    def contacts(self):
        """Count the contacts."""
        return len(self.touches())

    def asleep(self):
        """Count the bodies that sleep."""
        return 0

    @property
    def complaints(self):
        """Return the stable engine's complaints about the scene: other engines declare nothing."""
        return Stable(self.scene).complaints


class Lesson(Builder):
    """The lesson's engine: the one in this folder, yours. It has no springs."""

    name = "lesson"

    def __init__(self, scene, passes=ITERATIONS, substeps=1):
        self.scene, self.substeps = scene, substeps
        rates = scene.damping if "Damping" in scene.effects else (0.0, 0.0)
        self.world = mini_engine.World(scene.gravity, *rates)
        self.world.iterations = passes
        self.fill()

    def add(self, data):
        return self.world.add(self.body(data))

    def rod(self, a, b):
        rod = mini_engine.DistanceJoint(self.bodies[a], self.bodies[b])
        self.world.joints.append(rod)

    def spring(self, s):
        """Leave out a spring: this engine has none."""

    def body(self, data):
        effects = self.scene.effects
        friction = data.friction if "Friction" in effects else 0.0
        restitution = data.restitution if "Bounce" in effects else 0.0
        if not isinstance(data, Ball):
            shape = mini_engine.Box(Vector2(data.half))
            return mini_engine.Body(shape, data.pos, 0.0, restitution, friction)
        shape = mini_engine.Circle(data.radius)
        body = mini_engine.Body(shape, data.pos, data.mass, restitution, friction)
        body.vel, body.omega = Vector2(data.vel), data.omega
        return body

    def step(self, dt):
        for _ in range(self.substeps):
            self.world.step(dt / self.substeps)

    def read(self, i):
        body = self.bodies[i]
        return State(*body.pos, *body.vel, body.angle, body.omega)

    def throw(self, i, velocity):
        self.bodies[i].vel = Vector2(velocity)

    def touches(self):
        return [Touch(*c.point, *c.normal, c.jn) for c in self.world.contacts]


class Stable(Builder):
    """The stable engine, with the effects the scene calls for."""

    name = "stable"
    package = stable_engine  # or its compiled copy: see compiled.py

    def __init__(self, scene, substeps=SUBSTEPS):
        self.scene, self.substeps = scene, substeps
        effects = [self.effect(name) for name in scene.effects]
        self.world = self.package.World(scene.gravity, substeps, effects, unit=scene.unit)
        self.fill()
        self.said = self.world.check()  # called here, so that no step warns

    @property
    def complaints(self):
        return self.said

    def effect(self, name):
        make = getattr(self.package, name)
        return make(*self.scene.damping) if name == "Damping" else make()

    def add(self, data):
        return self.world.add(self.body(data))

    def rod(self, a, b):
        self.world.add(self.package.Rod(self.bodies[a], self.bodies[b]))

    def spring(self, s):
        ends = self.bodies[s.a], self.bodies[s.b]
        self.world.add(self.package.Spring(*ends, s.stiffness, s.damping, s.length))

    def body(self, data):
        surface = {"restitution": data.restitution, "friction": data.friction}
        if not isinstance(data, Ball):
            return self.package.Body(self.package.Box(data.half), data.pos, **surface)
        bullet = data.bullet and "Bullets" in self.scene.effects
        shape = self.package.Circle(data.radius)
        body = self.package.Body(shape, data.pos, data.mass, bullet=bullet, **surface)
        body.vel, body.omega = data.vel, data.omega
        return body

    def step(self, dt):
        self.world.step(dt)

    def read(self, i):
        body = self.bodies[i]
        return State(body.x, body.y, body.vx, body.vy, body.angle, body.w)

    def throw(self, i, velocity):
        self.bodies[i].vel = velocity

    def touches(self):
        """Return contacts: the point is on the rim of the first body, a ball.

        Impulses are those of the latest substep, times the number of substeps.
        """
        effect = self.world.effects.get("Contacts")
        found = []
        for c in effect.touching if effect else ():
            x, y = (place + c.a.shape.radius * n for place, n in ((c.a.x, c.nx), (c.a.y, c.ny)))
            found.append(Touch(x, y, c.nx, c.ny, c.jn * self.substeps))
        return found

    def asleep(self):
        return sum(body.asleep for body in self.bodies)


class Pymunk(Builder):
    """The same scene in pymunk.

    pymunk multiplies what two surfaces have; the other engines take the root of the product of
    their friction and the smaller restitution. So each surface gets the root of its own: the same
    friction for any pair, and the same restitution where both surfaces are alike.
    """

    name = "pymunk"

    def __init__(self, scene, passes=PASSES, substeps=1, slop=None):
        self.scene, self.substeps = scene, substeps
        self.space = pymunk.Space()
        self.space.gravity = scene.gravity
        self.space.iterations = passes
        if slop is not None:
            self.space.collision_slop = slop  # px, the overlap that it leaves alone
        if "Sleep" in scene.effects:
            self.space.sleep_time_threshold = SLEEPY
        if "Damping" in scene.effects:
            self.space.damping = math.exp(-scene.damping[0])  # the share kept per second
        self.fill()

    def add(self, data):
        if isinstance(data, Ball) and data.mass > 0:
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
        effects = self.scene.effects
        shape.friction = math.sqrt(data.friction) if "Friction" in effects else 0.0
        shape.elasticity = math.sqrt(data.restitution) if "Bounce" in effects else 0.0
        if "Contacts" not in effects:
            shape.filter = pymunk.ShapeFilter(group=1)
        self.space.add(body, shape)
        return body

    def rod(self, a, b):
        self.tie(pymunk.PinJoint(self.bodies[a], self.bodies[b]))

    def spring(self, s):
        ends = self.bodies[s.a], self.bodies[s.b], (0, 0), (0, 0)
        self.tie(pymunk.DampedSpring(*ends, s.length, s.stiffness, s.damping))

    def tie(self, joint):
        """Add a joint. The two bodies that it ties do not collide."""
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
            points = arbiter.contact_point_set
            first, second = arbiter.bodies
            for point in points.points:
                place = (point.point_a + point.point_b) / 2
                share = arbiter.total_impulse.length / len(points.points)
                found[frozenset((first.id, second.id)), place] = Touch(
                    *place, *points.normal, share
                )

        for body in self.bodies:
            if body.body_type != STATIC:
                body.each_arbiter(look)
        return list(found.values())

    def lag(self, dt):
        """Return the lag: pymunk moves first and changes velocities then, half a step ahead."""
        return -dt / self.substeps / 2

    def asleep(self):
        return sum(body.is_sleeping for body in self.bodies)


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

    def __init__(self, scene, passes=BOX2D_PASSES, substeps=1):
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


BUILDERS = (Lesson, Stable, Pymunk, Box2d) if Box2D else (Lesson, Stable, Pymunk)
ENGINES = {engine.name: engine for engine in BUILDERS}
