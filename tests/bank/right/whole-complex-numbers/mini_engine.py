"""The mini engine with complex numbers as vectors: x + y j. Outside, vectors are pygame's."""

import cmath
import math
import random

import pygame
from pygame import Vector2

from lab_runtime import frame_budget

WIDTH, HEIGHT = 900, 600
STEP = 1 / 120
MAX_STEPS = 8
ITERATIONS = 8
BETA = 0.2
SLOP = 0.5
RESTING_SPEED = 30
MAX_BALLS = 40


def z(v):
    """A complex number from a vector or a pair."""
    return v if isinstance(v, complex) else complex(v[0], v[1])


def vec(c):
    return Vector2(c.real, c.imag)


def dot(p, q):
    return (p.conjugate() * q).real


def wedge(p, q):
    return (p.conjugate() * q).imag


def outside(name):
    """A property that shows the complex attribute _name as a Vector2."""

    def get(self):
        return vec(getattr(self, "_" + name))

    def put(self, value):
        setattr(self, "_" + name, z(value))

    return property(get, put)


def cross(a, b):
    return wedge(z(a), z(b))


def spin_velocity(omega, r):
    return vec(1j * omega * z(r))


class Circle:
    def __init__(self, radius):
        if not radius > 0:
            raise ValueError(f"radius {radius} must be above 0")
        self.radius = radius


class Box:
    def __init__(self, half):
        self.half = Vector2(half)


class Body:
    pos = outside("pos")
    vel = outside("vel")

    def __init__(self, shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(170, 190, 220)):
        if mass != 0 and isinstance(shape, Box):
            raise ValueError("A box cannot have a mass.")
        self.shape = shape
        self.pos = pos
        self.vel = 0j
        self.angle = 0.0
        self.omega = 0.0
        self.inv_mass = self.inv_inertia = 0.0
        if mass:
            self.inv_mass = 1 / mass
            self.inv_inertia = 1 / (mass * shape.radius**2 / 2)
        self.restitution = restitution
        self.friction = friction
        self.color = color

    @property
    def is_static(self):
        return self.inv_mass == 0.0


class Contact:
    normal = outside("normal")
    point = outside("point")

    def __init__(self, a, b, normal, depth, point):
        self.a, self.b = a, b
        self.normal, self.depth, self.point = normal, depth, point
        self.jn = 0.0
        self.jt = 0.0
        self.target = 0.0

    def arms(self):
        return self._point - self.a._pos, self._point - self.b._pos

    def speed(self, axis):
        ra, rb = self.arms()
        v = self.b._vel + 1j * self.b.omega * rb - self.a._vel - 1j * self.a.omega * ra
        return dot(v, axis)


def circle_circle(a, b):
    distance, angle = cmath.polar(b._pos - a._pos)
    reach = a.shape.radius + b.shape.radius
    if distance >= reach:
        return None
    normal = (b._pos - a._pos) / distance if distance else 1j
    return Contact(a, b, normal, reach - distance, a._pos + normal * a.shape.radius)


def circle_box(a, b):
    hx, hy = b.shape.half
    rel = a._pos - b._pos
    near = complex(min(max(rel.real, -hx), hx), min(max(rel.imag, -hy), hy))
    r = a.shape.radius
    way = near - rel
    if way:
        if abs(way) >= r:
            return None
        return Contact(a, b, way / abs(way), r - abs(way), b._pos + near)
    gap_x, gap_y = hx - abs(rel.real), hy - abs(rel.imag)
    if gap_x < gap_y:
        out, gap = complex(math.copysign(1, rel.real)), gap_x
    else:
        out, gap = 1j * math.copysign(1, rel.imag), gap_y
    return Contact(a, b, -out, r + gap, a._pos + gap * out)


def collide(a, b):
    round_a, round_b = isinstance(a.shape, Circle), isinstance(b.shape, Circle)
    if round_a and round_b:
        return circle_circle(a, b)
    if round_a:
        return circle_box(a, b)
    if round_b:
        return circle_box(b, a)
    return None


def push(a, b, p, ra, rb):
    a._vel -= p * a.inv_mass
    b._vel += p * b.inv_mass
    a.omega -= wedge(ra, p) * a.inv_inertia
    b.omega += wedge(rb, p) * b.inv_inertia


def apply_impulse(a, b, impulse, ra, rb):
    push(a, b, z(impulse), z(ra), z(rb))


def effective_mass(a, b, ra, rb, axis):
    n = z(axis)
    return (
        a.inv_mass
        + b.inv_mass
        + wedge(z(ra), n) ** 2 * a.inv_inertia
        + wedge(z(rb), n) ** 2 * b.inv_inertia
    )


class DistanceJoint:
    axis = outside("axis")

    def __init__(self, a, b):
        self.a, self.b = a, b
        self.length = abs(b._pos - a._pos)
        self.axis = 1j
        self.bias = 0.0
        self.k = 0.0

    def prepare(self, dt):
        rod = self.b._pos - self.a._pos
        self.axis = rod / abs(rod) if rod else 1j
        self.bias = -BETA / dt * (abs(rod) - self.length)
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        if self.k == 0:
            return
        size = (self.bias - dot(self.b._vel - self.a._vel, self._axis)) / self.k
        self.a._vel -= size * self.a.inv_mass * self._axis
        self.b._vel += size * self.b.inv_mass * self._axis


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
        for i, a in enumerate(self.bodies):
            for b in self.bodies[i + 1 :]:
                if a.is_static and b.is_static:
                    continue
                contact = collide(a, b)
                if contact is not None:
                    found.append(contact)
        return found

    def solve_contact(self, c, dt):
        ra, rb = c.arms()
        normal = c._normal
        total = max(0.0, c.jn + (c.target - c.speed(normal)) / effective_mass(c.a, c.b, ra, rb, normal))
        push(c.a, c.b, (total - c.jn) * normal, ra, rb)
        c.jn = total
        tangent = 1j * normal
        limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
        total = c.jt - c.speed(tangent) / effective_mass(c.a, c.b, ra, rb, tangent)
        total = max(-limit, min(limit, total))
        push(c.a, c.b, (total - c.jt) * tangent, ra, rb)
        c.jt = total

    def step(self, dt):
        g = z(self.gravity)
        moving = [body for body in self.bodies if not body.is_static]
        for body in moving:
            body._vel = (body._vel + g * dt) * math.exp(-self.linear_damping * dt)
            body.omega *= math.exp(-self.angular_damping * dt)

        self.contacts = self.find_contacts()

        for c in self.contacts:
            vn = c.speed(c._normal)
            e = min(c.a.restitution, c.b.restitution)
            c.target = max(-e * vn if -vn > RESTING_SPEED else 0.0, BETA / dt * max(c.depth - SLOP, 0))
        for joint in self.joints:
            joint.prepare(dt)
        for _ in range(ITERATIONS):
            for c in self.contacts:
                self.solve_contact(c, dt)
            for joint in self.joints:
                joint.solve()

        for body in moving:
            body._pos += body._vel * dt
            body.angle += body.omega * dt


def ball(rng, pos):
    radius = rng.randint(10, 22)
    color = tuple(rng.randint(90, 240) for _ in range(3))
    return Body(Circle(radius), pos, radius**2 / 100, restitution=0.4, friction=0.6, color=color)


def make_world(rng):
    grey = (84, 90, 104)
    world = World()
    world.add(Body(Box((450, 20)), (450, 580), color=grey))
    world.add(Body(Box((20, 300)), (-20, 300), color=grey))
    world.add(Body(Box((20, 300)), (920, 300), color=grey))
    world.add(Body(Box((150, 10)), (200, 260), color=grey))
    for i in range(5):
        world.add(Body(Circle(8), (375 + 60 * i, 400), color=grey))
    anchor = world.add(Body(Circle(6), (700, 90), color=grey))
    bob = world.add(Body(Circle(24), (840, 90), 6, restitution=0.2))
    world.joints.append(DistanceJoint(anchor, bob))
    for i in range(8):
        world.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return world


def advance(world, accumulator, frame_seconds):
    accumulator += min(frame_seconds, MAX_STEPS * STEP)
    steps = 0
    while accumulator >= STEP:
        world.step(STEP)
        accumulator -= STEP
        steps += 1
    return accumulator, steps


def draw(screen, font, world):
    screen.fill((20, 20, 30))
    for joint in world.joints:
        pygame.draw.line(screen, (220, 220, 220), joint.a.pos, joint.b.pos, 2)
    for body in world.bodies:
        if isinstance(body.shape, Box):
            pygame.draw.rect(screen, body.color, pygame.Rect(body.pos - body.shape.half, body.shape.half * 2))
            continue
        pygame.draw.circle(screen, body.color, body.pos, body.shape.radius)
        if not body.is_static:
            tip = body._pos + cmath.rect(body.shape.radius, body.angle)
            pygame.draw.line(screen, (20, 20, 30), body.pos, vec(tip), 2)
    moving = sum(not body.is_static for body in world.bodies)
    text = f"moving bodies: {moving}  contacts: {len(world.contacts)}"
    screen.blit(font.render(text, True, (220, 220, 220)), (10, 10))
    pygame.display.flip()


def main():
    pygame.init()
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    font = pygame.font.Font(None, 24)
    clock = pygame.time.Clock()
    rng = random.Random(12)
    world = make_world(rng)
    accumulator, total = 0.0, 0
    running = True
    while running and frame_budget():
        seconds = clock.tick(60) / 1000
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
                if sum(not body.is_static for body in world.bodies) < MAX_BALLS:
                    world.add(ball(rng, event.pos))
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                rng = random.Random(12)
                world = make_world(rng)
        accumulator, steps = advance(world, accumulator, seconds)
        total += steps
        draw(screen, font, world)
    pygame.quit()
    rod = world.joints[0]
    print(f"Fixed steps: {total}")
    print(f"Pendulum length error: {abs(abs(rod.b._pos - rod.a._pos) - rod.length):.2f} px")


if __name__ == "__main__":
    main()
