"""My mini engine in one file: shapes, bodies, contacts, a rod, the world and the window."""

import math
import random

import pygame
from pygame import Vector2

WIDTH, HEIGHT = 900, 600  # px
STEP = 1 / 120  # s
MAX_STEPS = 8
MAX_FRAME = MAX_STEPS * STEP  # as the wrong members of TODO 6 call it
ITERATIONS = 8
BETA = 0.2
SLOP = 0.5  # px
RESTING_SPEED = 30  # px/s
MAX_BALLS = 40

GREY = (90, 90, 100)
PALETTE = [(230, 120, 90), (120, 200, 120), (110, 160, 230), (220, 200, 110), (190, 130, 210)]


def cross(a, b):
    return a.x * b.y - a.y * b.x


def spin_velocity(omega, r):
    return Vector2(-omega * r.y, omega * r.x)


class Circle:
    def __init__(self, radius):
        self.radius = radius


class Box:
    """An upright rectangle; half is half its width and half its height."""

    def __init__(self, half):
        self.half = Vector2(half)


class Body:
    def __init__(self, shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(180, 180, 190)):
        if isinstance(shape, Box) and mass:
            raise ValueError(f"A box cannot move, so its mass must be 0, not {mass}.")
        self.shape = shape
        self.pos = Vector2(pos)
        self.vel = Vector2()
        self.angle = 0.0
        self.omega = 0.0
        self.restitution = restitution
        self.friction = friction
        self.color = color
        self.is_static = mass == 0
        if self.is_static:
            self.inv_mass = self.inv_inertia = 0.0
        else:
            self.inv_mass = 1 / mass
            self.inv_inertia = 2 / (mass * shape.radius * shape.radius)


class Contact:
    def __init__(self, a, b, normal, depth, point):
        self.a, self.b = a, b
        self.normal = normal
        self.depth = depth
        self.point = point
        self.jn = self.jt = 0.0
        self.target = 0.0


def circle_circle(a, b):
    between = b.pos - a.pos
    distance = between.length()
    depth = a.shape.radius + b.shape.radius - distance
    if depth <= 0:
        return None
    normal = between / distance if distance else Vector2(0, 1)
    return Contact(a, b, normal, depth, a.pos + normal * a.shape.radius)


def circle_box(a, b):
    # TODO 1: find the contact of a circle and a box
    d = a.pos - b.pos
    hx, hy = b.shape.half
    nearest = Vector2(min(max(d.x, -hx), hx), min(max(d.y, -hy), hy))
    if abs(d.x) <= hx and abs(d.y) <= hy:
        if hx - abs(d.x) < hy - abs(d.y):
            side = 1 if d.x > 0 else -1
            face = Vector2(side * hx, d.y)
            return Contact(a, b, Vector2(-side, 0), a.shape.radius + hx - abs(d.x), b.pos + face)
        side = 1 if d.y > 0 else -1
        face = Vector2(d.x, side * hy)
        return Contact(a, b, Vector2(0, -side), a.shape.radius + hy - abs(d.y), b.pos + face)
    away = (nearest - d).length()
    if away >= a.shape.radius:
        return None
    return Contact(a, b, (nearest - d) / away, a.shape.radius - away, b.pos + nearest)
    # END TODO 1


def collide(a, b):
    if isinstance(a.shape, Box):
        a, b = b, a
    if isinstance(a.shape, Box):
        return None
    if isinstance(b.shape, Box):
        return circle_box(a, b)
    return circle_circle(a, b)


def apply_impulse(a, b, impulse, ra, rb):
    for body, push, arm in ((a, -impulse, ra), (b, impulse, rb)):
        body.vel = body.vel + push * body.inv_mass
        body.omega += cross(arm, push) * body.inv_inertia


def effective_mass(a, b, ra, rb, axis):
    total = a.inv_mass + b.inv_mass
    # TODO 2: add the spin terms
    for body, arm in ((a, ra), (b, rb)):
        lever = cross(arm, axis)
        total += lever * lever * body.inv_inertia
    # END TODO 2
    return total


class DistanceJoint:
    def __init__(self, a, b):
        self.a = a
        self.b = b
        self.length = a.pos.distance_to(b.pos)
        self.axis = Vector2(1, 0)
        self.bias = 0.0
        self.k = 0.0

    def prepare(self, dt):
        rod = self.b.pos - self.a.pos
        distance = rod.length()
        if distance:
            self.axis = rod / distance
        self.bias = BETA * (self.length - distance) / dt
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        # TODO 3: hold the rod's length
        if self.k > 0:
            stretching = self.axis.dot(self.b.vel) - self.axis.dot(self.a.vel)
            impulse = (self.bias - stretching) / self.k
            self.a.vel = self.a.vel - self.axis * impulse * self.a.inv_mass
            self.b.vel = self.b.vel + self.axis * impulse * self.b.inv_mass
        # END TODO 3


def friction_limit(c):
    return math.sqrt(c.a.friction * c.b.friction) * c.jn


class World:
    def __init__(self, gravity=(0, 980), linear_damping=0.05, angular_damping=0.3):
        self.gravity = Vector2(gravity)
        self.linear_damping = linear_damping
        self.angular_damping = angular_damping
        self.bodies = []
        self.joints = []
        self.contacts = []

    def add(self, body):
        self.bodies.append(body)
        return body

    def find_contacts(self):
        found = []
        for i in range(len(self.bodies)):
            for j in range(i):
                a, b = self.bodies[j], self.bodies[i]
                if not (a.is_static and b.is_static):
                    found.append(collide(a, b))
        return [contact for contact in found if contact]

    def solve_contact(self, c, dt):
        a, b = c.a, c.b
        ra, rb = c.point - a.pos, c.point - b.pos

        # push apart
        gap = b.vel + spin_velocity(b.omega, rb) - a.vel - spin_velocity(a.omega, ra)
        missing = c.target - gap.dot(c.normal)
        jn = max(0.0, c.jn + missing / effective_mass(a, b, ra, rb, c.normal))
        apply_impulse(a, b, (jn - c.jn) * c.normal, ra, rb)
        c.jn = jn

        # friction
        tangent = Vector2(-c.normal.y, c.normal.x)
        gap = b.vel + spin_velocity(b.omega, rb) - a.vel - spin_velocity(a.omega, ra)
        total = c.jt - gap.dot(tangent) / effective_mass(a, b, ra, rb, tangent)
        # TODO 4: clamp the friction total
        limit = friction_limit(c)
        if abs(total) > limit:
            total = math.copysign(limit, total)
        # END TODO 4
        apply_impulse(a, b, (total - c.jt) * tangent, ra, rb)
        c.jt = total

    def step(self, dt):
        # forces and damping
        for body in self.bodies:
            if body.is_static:
                continue
            # TODO 5: damp by a rate per second
            keep_vel = math.exp(-dt * self.linear_damping)
            keep_omega = math.exp(-dt * self.angular_damping)
            # END TODO 5
            body.vel = (body.vel + self.gravity * dt) * keep_vel
            body.omega *= keep_omega

        # contacts and the speeds they want
        self.contacts = self.find_contacts()
        for c in self.contacts:
            a, b = c.a, c.b
            gap = b.vel + spin_velocity(b.omega, c.point - b.pos)
            gap -= a.vel + spin_velocity(a.omega, c.point - a.pos)
            closing = -gap.dot(c.normal)
            c.target = BETA / dt * max(0.0, c.depth - SLOP)
            if closing > RESTING_SPEED:
                c.target = max(c.target, min(a.restitution, b.restitution) * closing)
        for joint in self.joints:
            joint.prepare(dt)

        # impulses
        for _ in range(ITERATIONS):
            for c in self.contacts:
                self.solve_contact(c, dt)
            for joint in self.joints:
                joint.solve()

        # positions
        for body in self.bodies:
            if not body.is_static:
                body.pos = body.pos + body.vel * dt
                body.angle += body.omega * dt


def ball(rng, pos):
    radius = rng.randint(10, 22)
    color = rng.choice(PALETTE)
    return Body(Circle(radius), pos, radius * radius / 100, 0.4, 0.6, color)


def make_world(rng):
    world = World()
    world.add(Body(Box((450, 20)), (450, 580), color=GREY))
    world.add(Body(Box((20, 300)), (-20, 300), color=GREY))
    world.add(Body(Box((20, 300)), (920, 300), color=GREY))
    world.add(Body(Box((150, 10)), (200, 260), color=GREY))
    for i in range(5):
        world.add(Body(Circle(8), (375 + 60 * i, 400), color=GREY))
    hook = world.add(Body(Circle(6), (700, 90), color=GREY))
    bob = world.add(Body(Circle(24), (840, 90), 6, restitution=0.2))
    world.joints.append(DistanceJoint(hook, bob))
    for i in range(8):
        world.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return world


def main():
    pygame.init()
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    font = pygame.font.Font(None, 24)
    clock = pygame.time.Clock()
    rng = random.Random(12)
    world = make_world(rng)
    accumulator = 0.0
    total_steps = 0
    running = True
    while running:
        frame_seconds = clock.tick(60) / 1000
        moving = sum(not body.is_static for body in world.bodies)
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1 and moving < MAX_BALLS:
                world.add(ball(rng, event.pos))
                moving += 1
            if event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                rng = random.Random(12)
                world = make_world(rng)

        # TODO 6: run whole steps from the accumulator
        accumulator += min(frame_seconds, MAX_STEPS * STEP)
        steps = 0
        while accumulator >= STEP:
            accumulator -= STEP
            world.step(STEP)
            steps += 1
        # END TODO 6
        total_steps += steps

        screen.fill((20, 20, 28))
        for joint in world.joints:
            pygame.draw.line(screen, "white", joint.a.pos, joint.b.pos, 2)
        for body in world.bodies:
            if isinstance(body.shape, Box):
                size = body.shape.half * 2
                pygame.draw.rect(screen, body.color, (body.pos - body.shape.half, size))
            else:
                pygame.draw.circle(screen, body.color, body.pos, body.shape.radius)
                if not body.is_static:
                    rim = Vector2(body.shape.radius, 0).rotate_rad(body.angle)
                    pygame.draw.line(screen, "black", body.pos, body.pos + rim, 2)
        text = f"{moving} moving bodies, {len(world.contacts)} contacts"
        screen.blit(font.render(text, True, "white"), (10, 10))
        pygame.display.flip()
    pygame.quit()
    rod = world.joints[0]
    error = abs(rod.a.pos.distance_to(rod.b.pos) - rod.length)
    print(f"{total_steps} fixed steps")
    print(f"Pendulum length error: {error:.2f} px")


if __name__ == "__main__":
    main()
