"""A small 2D rigid-body engine: balls, pegs, ledges and a pendulum. Units: px, s, rad; y down."""

import math
import random

import pygame
from pygame import Vector2

from lab_runtime import frame_budget

WIDTH, HEIGHT = 900, 600  # px
STEP = 1 / 120  # s
MAX_STEPS = 8  # in one frame
ITERATIONS = 8  # solver passes in one step
BETA = 0.2  # share of an error removed in one step
SLOP = 0.5  # px of overlap that is left alone
RESTING_SPEED = 30  # px/s, slower contacts do not bounce
MAX_BALLS = 40  # moving bodies
GREY = (95, 100, 112)


def cross(a, b):
    """Return the 2D cross product, a number."""
    return a.x * b.y - a.y * b.x


def spin_velocity(omega, r):
    """Return the velocity that a spin gives to the point at r from the centre."""
    return Vector2(-omega * r.y, omega * r.x)


class Circle:
    """A disc."""

    def __init__(self, radius):
        self.radius = radius


class Box:
    """An axis-aligned box with half extents; static only."""

    def __init__(self, half):
        self.half = Vector2(half)


class Body:
    """A rigid body; mass 0 makes it static."""

    def __init__(self, shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(200, 200, 200)):
        if isinstance(shape, Box) and mass > 0:
            raise ValueError("a Box must be static: mass 0")
        self.shape = shape
        self.pos = Vector2(pos)
        self.vel = Vector2(0, 0)
        self.angle = 0.0
        self.omega = 0.0
        self.restitution = restitution
        self.friction = friction
        self.color = color
        if mass > 0:
            self.inv_mass = 1 / mass
            self.inv_inertia = 1 / (0.5 * mass * shape.radius**2)
        else:
            self.inv_mass = 0.0
            self.inv_inertia = 0.0

    @property
    def is_static(self):
        """Return True if nothing can move this body."""
        return self.inv_mass == 0


class Contact:
    """Two touching bodies; the normal points from A to B."""

    def __init__(self, a, b, normal, depth, point):
        self.a, self.b = a, b
        self.normal = normal
        self.depth = depth
        self.point = point
        self.jn = 0.0  # accumulated normal impulse
        self.jt = 0.0  # accumulated friction impulse
        self.target = 0.0  # wanted speed along the normal


def circle_circle(a, b):
    """Return the contact of two circles, or None."""
    d = b.pos - a.pos
    dist = d.length()
    depth = a.shape.radius + b.shape.radius - dist
    if depth <= 0:
        return None
    normal = d / dist if dist > 0 else Vector2(0, 1)
    return Contact(a, b, normal, depth, a.pos + normal * a.shape.radius)


def circle_box(a, b):
    """Return the contact of circle a and box b, or None."""
    low = b.pos - b.shape.half
    high = b.pos + b.shape.half
    closest = Vector2(
        max(low.x, min(a.pos.x, high.x)),
        max(low.y, min(a.pos.y, high.y)),
    )
    d = closest - a.pos
    dist = d.length()
    if dist > 0:
        if dist >= a.shape.radius:
            return None
        return Contact(a, b, d / dist, a.shape.radius - dist, closest)
    # The centre is inside the box: leave through the nearest face.
    faces = [
        (a.pos.x - low.x, Vector2(1, 0), Vector2(low.x, a.pos.y)),
        (high.x - a.pos.x, Vector2(-1, 0), Vector2(high.x, a.pos.y)),
        (a.pos.y - low.y, Vector2(0, 1), Vector2(a.pos.x, low.y)),
        (high.y - a.pos.y, Vector2(0, -1), Vector2(a.pos.x, high.y)),
    ]
    gap, normal, point = min(faces, key=lambda face: face[0])
    return Contact(a, b, normal, a.shape.radius + gap, point)


def collide(a, b):
    """Return the contact of any two bodies, with the circle as A, or None."""
    if isinstance(a.shape, Circle) and isinstance(b.shape, Circle):
        return circle_circle(a, b)
    if isinstance(a.shape, Circle):
        return circle_box(a, b)
    if isinstance(b.shape, Circle):
        return circle_box(b, a)
    return None


def apply_impulse(a, b, impulse, ra, rb):
    """Apply -impulse to A and +impulse to B."""
    a.vel -= impulse * a.inv_mass
    a.omega -= cross(ra, impulse) * a.inv_inertia
    b.vel += impulse * b.inv_mass
    b.omega += cross(rb, impulse) * b.inv_inertia


def effective_mass(a, b, ra, rb, axis):
    """Return the inverse effective mass of two bodies along an axis."""
    return (
        a.inv_mass
        + b.inv_mass
        + cross(ra, axis) ** 2 * a.inv_inertia
        + cross(rb, axis) ** 2 * b.inv_inertia
    )


class DistanceJoint:
    """A rod between the centres of two bodies."""

    def __init__(self, a, b):
        self.a, self.b = a, b
        self.length = (b.pos - a.pos).length()

    def prepare(self, dt):
        """Set up the rod for one step."""
        d = self.b.pos - self.a.pos
        dist = d.length()
        self.axis = d / dist if dist > 0 else Vector2(1, 0)
        self.bias = -BETA / dt * (dist - self.length)
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        """Run one velocity pass."""
        if self.k == 0:
            return
        speed = (self.b.vel - self.a.vel).dot(self.axis)
        impulse = self.axis * ((self.bias - speed) / self.k)
        self.a.vel -= impulse * self.a.inv_mass
        self.b.vel += impulse * self.b.inv_mass


class World:
    """All bodies and joints, and the step that moves them."""

    def __init__(self, gravity=(0, 980), linear_damping=0.05, angular_damping=0.3):
        self.gravity = Vector2(gravity)
        self.linear_damping = linear_damping
        self.angular_damping = angular_damping
        self.bodies = []
        self.joints = []
        self.contacts = []

    def add(self, body):
        """Add a body and return it."""
        self.bodies.append(body)
        return body

    def find_contacts(self):
        """Return the contacts at the current positions."""
        contacts = []
        for i, a in enumerate(self.bodies):
            for b in self.bodies[i + 1 :]:
                if a.is_static and b.is_static:
                    continue
                contact = collide(a, b)
                if contact is not None:
                    contacts.append(contact)
        return contacts

    def relative_velocity(self, c, ra, rb):
        """Return the velocity of B's contact point as seen from A's."""
        vel_a = c.a.vel + spin_velocity(c.a.omega, ra)
        vel_b = c.b.vel + spin_velocity(c.b.omega, rb)
        return vel_b - vel_a

    def solve_contact(self, c, dt):
        """Run one pass over one contact: the normal impulse, then friction."""
        ra, rb = c.point - c.a.pos, c.point - c.b.pos

        vn = self.relative_velocity(c, ra, rb).dot(c.normal)
        k = effective_mass(c.a, c.b, ra, rb, c.normal)
        total = max(0.0, c.jn + (c.target - vn) / k)
        apply_impulse(c.a, c.b, c.normal * (total - c.jn), ra, rb)
        c.jn = total

        tangent = Vector2(-c.normal.y, c.normal.x)
        vt = self.relative_velocity(c, ra, rb).dot(tangent)
        k = effective_mass(c.a, c.b, ra, rb, tangent)
        limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
        total = max(-limit, min(limit, c.jt - vt / k))
        apply_impulse(c.a, c.b, tangent * (total - c.jt), ra, rb)
        c.jt = total

    def step(self, dt):
        """Advance the world by dt."""
        # 1. forces
        for body in self.bodies:
            if not body.is_static:
                body.vel += self.gravity * dt
                body.vel *= math.exp(-self.linear_damping * dt)
                body.omega *= math.exp(-self.angular_damping * dt)
        # 2. contacts
        self.contacts = self.find_contacts()
        # 3. solve
        for c in self.contacts:
            ra, rb = c.point - c.a.pos, c.point - c.b.pos
            vn = self.relative_velocity(c, ra, rb).dot(c.normal)
            bounce = 0.0
            if vn < -RESTING_SPEED:
                bounce = -min(c.a.restitution, c.b.restitution) * vn
            push_out = BETA / dt * max(c.depth - SLOP, 0.0)
            c.target = max(bounce, push_out)
        for joint in self.joints:
            joint.prepare(dt)
        for _ in range(ITERATIONS):
            for c in self.contacts:
                self.solve_contact(c, dt)
            for joint in self.joints:
                joint.solve()
        # 4. move
        for body in self.bodies:
            if not body.is_static:
                body.pos += body.vel * dt
                body.angle += body.omega * dt


def ball(rng, pos):
    """Return a ball of random size and colour."""
    radius = rng.randint(10, 22)
    color = (rng.randint(90, 255), rng.randint(90, 255), rng.randint(90, 255))
    return Body(
        Circle(radius), pos, mass=radius**2 / 100, restitution=0.4, friction=0.6, color=color
    )


def make_world(rng):
    """Return the lab scene."""
    world = World()
    world.add(Body(Box((450, 20)), (450, 580), color=GREY))  # floor
    world.add(Body(Box((20, 300)), (-20, 300), color=GREY))  # walls
    world.add(Body(Box((20, 300)), (920, 300), color=GREY))
    world.add(Body(Box((150, 10)), (200, 260), color=GREY))  # ledge
    for i in range(5):
        world.add(Body(Circle(8), (375 + 60 * i, 400), color=GREY))  # pegs
    anchor = world.add(Body(Circle(6), (700, 90), color=GREY))
    bob = world.add(Body(Circle(24), (840, 90), mass=6, restitution=0.2, color=(250, 200, 90)))
    world.joints.append(DistanceJoint(anchor, bob))
    for i in range(8):
        world.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return world


def draw(screen, font, world):
    """Draw the world and the numbers above it."""
    screen.fill((24, 26, 32))
    for joint in world.joints:
        pygame.draw.line(screen, (230, 230, 230), joint.a.pos, joint.b.pos, 3)
    for body in world.bodies:
        if isinstance(body.shape, Box):
            rect = pygame.Rect(body.pos - body.shape.half, body.shape.half * 2)
            pygame.draw.rect(screen, body.color, rect)
        else:
            pygame.draw.circle(screen, body.color, body.pos, body.shape.radius)
            if not body.is_static:
                rim = body.pos + Vector2(body.shape.radius, 0).rotate_rad(body.angle)
                pygame.draw.line(screen, (24, 26, 32), body.pos, rim, 2)
    moving = sum(not body.is_static for body in world.bodies)
    text = f"moving bodies: {moving}   contacts: {len(world.contacts)}   click: ball   R: reset"
    screen.blit(font.render(text, True, (230, 230, 230)), (12, 10))
    pygame.display.flip()


def main():
    """Run the lab scene in a window."""
    pygame.init()
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    pygame.display.set_caption("Mini engine")
    font = pygame.font.Font(None, 24)
    clock = pygame.time.Clock()
    rng = random.Random(12)
    world = make_world(rng)
    accumulator = 0.0
    steps = 0
    running = True
    while running and frame_budget():
        accumulator += min(clock.tick(60) / 1000, MAX_STEPS * STEP)
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
                moving = sum(not body.is_static for body in world.bodies)
                if moving < MAX_BALLS:
                    world.add(ball(rng, event.pos))
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                world = make_world(rng)
        while accumulator >= STEP:
            world.step(STEP)
            accumulator -= STEP
            steps += 1
        draw(screen, font, world)
    pygame.quit()
    joint = world.joints[0]
    error = abs((joint.b.pos - joint.a.pos).length() - joint.length)
    print(f"Ran {steps} fixed steps of {STEP:.4f} s")
    print(f"Pendulum length error: {error:.2f} px")


if __name__ == "__main__":
    main()
