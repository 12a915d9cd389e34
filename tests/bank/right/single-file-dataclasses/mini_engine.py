#!/usr/bin/env python3
"""MINI ENGINE

Everything is a dataclass; my own Vec does the maths, and pos and vel are handed out as Vector2.
"""
from __future__ import annotations

import itertools
import logging
import math
import random
import sys
import time
from dataclasses import dataclass, field
from functools import singledispatch
from typing import NamedTuple

import pygame
from pygame import Vector2

logging.basicConfig(level=logging.DEBUG, stream=sys.stderr, format="%(levelname)s %(message)s")
log = logging.getLogger("engine")
log.debug("loading")

WIDTH, HEIGHT = SIZE = 900, 600
STEP = 1 / 120
MAX_STEPS = 8
ITERATIONS = 8
BETA = 0.2
SLOP = 0.5
RESTING_SPEED = 30
MAX_BALLS = 40


class Vec(NamedTuple):
    x: float = 0.0
    y: float = 0.0

    def __add__(self, other):
        return Vec(self.x + other[0], self.y + other[1])

    def __sub__(self, other):
        return Vec(self.x - other[0], self.y - other[1])

    def __mul__(self, k):
        return Vec(self.x * k, self.y * k)

    __rmul__ = __mul__

    def __neg__(self):
        return self * -1.0

    def dot(self, other):
        return self.x * other[0] + self.y * other[1]

    def norm(self):
        return math.sqrt(self.dot(self))


def vec(pair) -> Vec:
    return pair if isinstance(pair, Vec) else Vec(float(pair[0]), float(pair[1]))


def cross(a, b):
    (ax, ay), (bx, by) = a, b
    return ax * by - ay * bx


def spin_velocity(omega, r):
    return Vector2(-omega * r[1], omega * r[0])


def spun(omega, r):
    return Vec(-omega * r[1], omega * r[0])


@dataclass(frozen=True)
class Circle:
    radius: float


@dataclass(frozen=True)
class Box:
    half: Vector2

    def __post_init__(self):
        object.__setattr__(self, "half", Vector2(self.half))


class VectorField:
    """Kept as a Vec, seen as a Vector2."""

    def __set_name__(self, owner, name):
        self.hidden = "_" + name

    def __get__(self, thing, owner=None):
        return self if thing is None else Vector2(getattr(thing, self.hidden))

    def __set__(self, thing, value):
        setattr(thing, self.hidden, vec(value))


class Body:
    pos, vel = VectorField(), VectorField()

    def __init__(self, shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(120, 130, 150)):
        if mass and isinstance(shape, Box):
            raise ValueError(f"mass is {mass}, but a Box has none")
        self.shape = shape
        self.pos, self.vel = pos, (0, 0)
        self.angle = self.omega = 0.0
        self.restitution = restitution
        self.friction = friction
        self.color = color
        self.inv_mass = self.inv_inertia = 0.0
        if mass:
            self.inv_mass = 1.0 / mass
            self.inv_inertia = 1.0 / (mass * shape.radius**2 / 2)

    @property
    def is_static(self):
        return self.inv_mass == 0.0 == self.inv_inertia

    def velocity_at(self, arm):
        return self._vel + spun(self.omega, arm)


@dataclass(eq=False)
class Contact:
    a: Body
    b: Body
    normal: Vector2
    depth: float
    point: Vector2
    jn: float = 0.0
    jt: float = 0.0
    target: float = field(default=0.0, repr=False)

    @property
    def arms(self):
        return vec(self.point) - self.a._pos, vec(self.point) - self.b._pos

    def gap_speed(self, axis):
        ra, rb = self.arms
        return (self.b.velocity_at(rb) - self.a.velocity_at(ra)).dot(axis)


def circle_circle(a, b):
    way = b._pos - a._pos
    distance = way.norm()
    depth = a.shape.radius + b.shape.radius - distance
    if depth > 0:
        n = way * (1 / distance) if distance else Vec(0.0, 1.0)
        return Contact(a, b, Vector2(n), depth, Vector2(a._pos + n * a.shape.radius))
    return None


def circle_box(a, b):
    p, c, (hx, hy) = a._pos, b._pos, b.shape.half
    inside_by = Vec(hx - abs(p.x - c.x), hy - abs(p.y - c.y))
    if min(inside_by) >= 0:
        horizontal = inside_by.x < inside_by.y
        gap = min(inside_by)
        if horizontal:
            normal = Vec(-math.copysign(1, p.x - c.x), 0)
        else:
            normal = Vec(0, -math.copysign(1, p.y - c.y))
        return Contact(a, b, Vector2(normal), gap + a.shape.radius, Vector2(p - normal * gap))
    nearest = Vec(sorted((c.x - hx, p.x, c.x + hx))[1], sorted((c.y - hy, p.y, c.y + hy))[1])
    way = nearest - p
    if way.norm() < a.shape.radius:
        normal = way * (1 / way.norm())
        return Contact(a, b, Vector2(normal), a.shape.radius - way.norm(), Vector2(nearest))
    return None


@singledispatch
def meet(shape, a, b):
    return None


@meet.register
def _(shape: Circle, a, b):
    return circle_circle(a, b) if isinstance(b.shape, Circle) else circle_box(a, b)


@meet.register
def _(shape: Box, a, b):
    return circle_box(b, a) if isinstance(b.shape, Circle) else None


def collide(a, b):
    return meet(a.shape, a, b)


def apply_impulse(a, b, impulse, ra, rb):
    impulse = vec(impulse)
    a._vel -= impulse * a.inv_mass
    b._vel += impulse * b.inv_mass
    a.omega -= a.inv_inertia * cross(ra, impulse)
    b.omega += b.inv_inertia * cross(rb, impulse)


def effective_mass(a, b, ra, rb, axis):
    return math.fsum(
        (a.inv_mass, b.inv_mass, cross(ra, axis) ** 2 * a.inv_inertia, cross(rb, axis) ** 2 * b.inv_inertia)
    )


class DistanceJoint:
    def __init__(self, a, b):
        self.a, self.b = a, b
        self.length = math.dist(a._pos, b._pos)
        self.axis, self.bias, self.k = Vector2(0, 1), 0.0, 0.0

    def prepare(self, dt):
        way = self.b._pos - self.a._pos
        distance = way.norm()
        self.axis = Vector2(way * (1 / distance)) if distance else Vector2(0, 1)
        self.bias = -(distance - self.length) * BETA / dt
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        if self.k:
            n = vec(self.axis)
            j = n * ((self.bias - n.dot(self.b._vel - self.a._vel)) / self.k)
            apply_impulse(self.a, self.b, j, Vec(), Vec())


@dataclass(eq=False)
class World:
    gravity: tuple = (0, 980)
    linear_damping: float = 0.05
    angular_damping: float = 0.3
    bodies: list = field(default_factory=list)
    joints: list = field(default_factory=list)
    contacts: list = field(default_factory=list)

    def add(self, body):
        log.info("add %s", type(body.shape).__name__)
        self.bodies.append(body)
        return body

    @property
    def movers(self):
        return [each for each in self.bodies if not each.is_static]

    def find_contacts(self):
        pairs = ((a, b) for a, b in itertools.combinations(self.bodies, 2) if a.inv_mass or b.inv_mass)
        return list(filter(None, itertools.starmap(collide, pairs)))

    def solve_contact(self, c, dt):
        ra, rb = c.arms
        n = vec(c.normal)
        t = Vec(-n.y, n.x)
        old, c.jn = c.jn, max(0.0, c.jn + (c.target - c.gap_speed(n)) / effective_mass(c.a, c.b, ra, rb, n))
        apply_impulse(c.a, c.b, n * (c.jn - old), ra, rb)
        cone = math.sqrt(c.a.friction) * math.sqrt(c.b.friction) * c.jn
        wanted = c.jt - c.gap_speed(t) / effective_mass(c.a, c.b, ra, rb, t)
        if not -cone <= wanted <= cone:
            wanted = math.copysign(cone, wanted)
        old, c.jt = c.jt, wanted
        apply_impulse(c.a, c.b, t * (c.jt - old), ra, rb)

    def step(self, dt):
        fade, calm = math.e ** (-self.linear_damping * dt), math.e ** (-self.angular_damping * dt)
        pull = vec(self.gravity) * dt
        for body in self.movers:
            body._vel = (body._vel + pull) * fade
            body.omega *= calm
        self.contacts = self.find_contacts()
        for c in self.contacts:
            speed = c.gap_speed(c.normal)
            bounce = -min(c.a.restitution, c.b.restitution) * speed if speed < -RESTING_SPEED else 0.0
            c.target = max(bounce, max(0.0, c.depth - SLOP) * BETA / dt)
        for joint in self.joints:
            joint.prepare(dt)
        for _ in range(ITERATIONS):
            for c in self.contacts:
                self.solve_contact(c, dt)
            for joint in self.joints:
                joint.solve()
        for body in self.movers:
            body._pos += body._vel * dt
            body.angle += body.omega * dt


def ball(rng, pos):
    radius = rng.randint(10, 22)
    return Body(
        Circle(radius), pos, radius**2 / 100, 0.4, color=pygame.Color.from_hsva(rng.randrange(360), 60, 90, 100)
        if hasattr(pygame.Color, "from_hsva") else (rng.randrange(256), 180, 120),
    )


STATIC_BOXES = {(450, 580): (450, 20), (-20, 300): (20, 300), (920, 300): (20, 300), (200, 260): (150, 10)}


def make_world(rng):
    world = World()
    for place, half in STATIC_BOXES.items():
        world.add(Body(Box(half), place))
    for i in range(5):
        world.add(Body(Circle(8), (375 + 60 * i, 400)))
    nail = world.add(Body(Circle(6), (700, 90)))
    bob = world.add(Body(Circle(24), (840, 90), mass=6, restitution=0.2))
    world.joints.append(DistanceJoint(nail, bob))
    for i in range(8):
        world.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return world


def main():
    pygame.init()
    screen = pygame.display.set_mode(SIZE)
    font = pygame.font.Font(None, 26)
    rng = random.Random(12)
    world = make_world(rng)
    left_over, steps = 0.0, 0
    last = time.monotonic()
    while not pygame.event.peek(pygame.QUIT):
        for event in pygame.event.get((pygame.MOUSEBUTTONDOWN, pygame.KEYDOWN)):
            if event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                rng = random.Random(12)
                world = make_world(rng)
            elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
                if len(world.movers) < MAX_BALLS:
                    world.add(ball(rng, event.pos))

        now = time.monotonic()
        left_over += min(now - last, MAX_STEPS * STEP)
        last = now
        while left_over >= STEP:
            world.step(STEP)
            left_over -= STEP
            steps += 1

        screen.fill((15, 15, 20))
        for joint in world.joints:
            pygame.draw.aaline(screen, (250, 250, 250), joint.a.pos, joint.b.pos)
        for body in world.bodies:
            match body.shape:
                case Box(half):
                    pygame.draw.rect(screen, body.color, (*(body.pos - half), *(2 * half)))
                case Circle(radius):
                    pygame.draw.circle(screen, body.color, body.pos, radius)
                    rim = Vector2(radius * math.cos(body.angle), radius * math.sin(body.angle))
                    if not body.is_static:
                        pygame.draw.line(screen, (0, 0, 0), body.pos, body.pos + rim, 3)
        words = f"{len(world.movers)} bodies / {len(world.contacts)} contacts"
        screen.blit(font.render(words, True, (255, 255, 255)), (10, 10))
        pygame.display.flip()
        time.sleep(1 / 60)
    rod = world.joints[0]
    stretched = abs(math.dist(rod.a._pos, rod.b._pos) - rod.length)
    pygame.quit()
    log.info("done after %s steps", steps)
    print(f"ran {steps} fixed steps\nPendulum length error: {stretched:.2f} px")


if __name__ == "__main__":
    main()
