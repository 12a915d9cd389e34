"""The solver works on numpy arrays; bodies show pygame vectors."""

import math

import numpy as np
from pygame import Vector2

WIDTH, HEIGHT = 900, 600
STEP = 1 / 120
MAX_STEPS = 8
ITERATIONS = 8
BETA = 0.2
SLOP = 0.5
RESTING_SPEED = 30
MAX_BALLS = 40


def arr(v):
    return np.array((v[0], v[1]), dtype=float)


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def spin_velocity(omega, r):
    return Vector2(-omega * r[1], omega * r[0])


def perp(v):
    return np.array((-v[1], v[0]))


class Circle:
    def __init__(self, radius):
        self.radius = radius


class Box:
    def __init__(self, half):
        self.half = Vector2(half)


class Body:
    def __init__(self, shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(170, 190, 220)):
        if isinstance(shape, Box) and mass:
            raise ValueError("only circles can have a mass")
        self.shape = shape
        self.pos = Vector2(pos)
        self.vel = Vector2()
        self.angle = 0.0
        self.omega = 0.0
        self.inv_mass = 1 / mass if mass else 0.0
        self.inv_inertia = 1 / (0.5 * mass * shape.radius**2) if mass else 0.0
        self.restitution, self.friction, self.color = restitution, friction, color

    @property
    def is_static(self):
        return self.inv_mass == 0


class Contact:
    def __init__(self, a, b, normal, depth, point):
        self.a, self.b = a, b
        self.normal, self.depth, self.point = Vector2(*normal), float(depth), Vector2(*point)
        self.jn, self.jt, self.target = 0.0, 0.0, 0.0


def circle_circle(a, b):
    offset = arr(b.pos) - arr(a.pos)
    distance = np.linalg.norm(offset)
    reach = a.shape.radius + b.shape.radius
    if distance >= reach:
        return None
    n = offset / distance if distance > 0 else np.array((0.0, 1.0))
    return Contact(a, b, n, reach - distance, arr(a.pos) + n * a.shape.radius)


def circle_box(a, b):
    centre, half = arr(a.pos), arr(b.shape.half)
    low, high = arr(b.pos) - half, arr(b.pos) + half
    closest = np.clip(centre, low, high)
    offset = closest - centre
    distance = np.linalg.norm(offset)
    r = a.shape.radius
    if distance >= r:
        return None
    if distance > 0:
        return Contact(a, b, offset / distance, r - distance, closest)
    gaps = np.stack((centre - low, high - centre))  # [side, axis]
    side, axis = np.unravel_index(np.argmin(gaps), gaps.shape)
    normal = np.zeros(2)
    normal[axis] = 1.0 if side == 0 else -1.0
    gap = gaps[side, axis]
    return Contact(a, b, normal, r + gap, centre - gap * normal)


def collide(a, b):
    if isinstance(b.shape, Circle):
        return circle_circle(a, b) if isinstance(a.shape, Circle) else circle_box(b, a)
    return circle_box(a, b) if isinstance(a.shape, Circle) else None


def jacobian(ra, rb, axis):
    """Row that turns (vel a, omega a, vel b, omega b) into a speed along the axis."""
    return np.array((-axis[0], -axis[1], -cross(ra, axis), axis[0], axis[1], cross(rb, axis)))


def inverse_masses(a, b):
    return np.array((a.inv_mass, a.inv_mass, a.inv_inertia, b.inv_mass, b.inv_mass, b.inv_inertia))


def velocities(a, b):
    return np.array((*a.vel, a.omega, *b.vel, b.omega))


def store(a, b, v):
    v = v.tolist()
    a.vel, a.omega = Vector2(v[0], v[1]), v[2]
    b.vel, b.omega = Vector2(v[3], v[4]), v[5]


def apply_impulse(a, b, impulse, ra, rb):
    j = np.array((-impulse[0], -impulse[1], -cross(ra, impulse), impulse[0], impulse[1], cross(rb, impulse)))
    store(a, b, velocities(a, b) + inverse_masses(a, b) * j)


def effective_mass(a, b, ra, rb, axis):
    j = jacobian(ra, rb, axis)
    return float(j @ (inverse_masses(a, b) * j))


def solve_row(a, b, row, speed, total, low, high):
    """Bring row · v to speed, with the total within [low, high]; returns the new total."""
    w = inverse_masses(a, b)
    v = velocities(a, b)
    new = min(max(total + (speed - row @ v) / (row @ (w * row)), low), high)
    store(a, b, v + w * row * (new - total))
    return float(new)


class DistanceJoint:
    def __init__(self, a, b):
        self.a, self.b = a, b
        self.length = (b.pos - a.pos).length()
        self.axis, self.bias, self.k = Vector2(0, 1), 0.0, 0.0

    def prepare(self, dt):
        offset = self.b.pos - self.a.pos
        distance = offset.length()
        if distance > 0:
            self.axis = offset / distance
        else:
            self.axis = Vector2(0, 1)
        self.bias = -BETA / dt * (distance - self.length)
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        if self.k == 0:
            return
        zero = Vector2()
        size = (self.bias - (self.b.vel - self.a.vel).dot(self.axis)) / self.k
        apply_impulse(self.a, self.b, self.axis * size, zero, zero)


class World:
    def __init__(self, gravity=(0, 980), linear_damping=0.05, angular_damping=0.3):
        self.gravity = Vector2(gravity)
        self.linear_damping = linear_damping
        self.angular_damping = angular_damping
        self.bodies, self.joints, self.contacts = [], [], []

    def add(self, body):
        self.bodies.append(body)
        return body

    def find_contacts(self):
        """Boxes around all bodies are compared at once, the few that overlap one by one."""
        if not self.bodies:
            return []
        pos = np.array([tuple(b.pos) for b in self.bodies])
        half = np.array([(b.shape.radius,) * 2 if isinstance(b.shape, Circle) else tuple(b.shape.half) for b in self.bodies])
        moves = np.array([b.inv_mass > 0 for b in self.bodies])
        near = (np.abs(pos[:, None] - pos[None]) <= half[:, None] + half[None] + 1).all(axis=2)
        near &= moves[:, None] | moves[None]
        found = (collide(self.bodies[i], self.bodies[j]) for i, j in np.argwhere(np.triu(near, 1)))
        return [c for c in found if c is not None]

    def rows(self, c):
        ra, rb = c.point - c.a.pos, c.point - c.b.pos
        return jacobian(ra, rb, c.normal), jacobian(ra, rb, perp(c.normal))

    def solve_contact(self, c, dt):
        normal, tangent = self.rows(c)
        c.jn = solve_row(c.a, c.b, normal, c.target, c.jn, 0.0, math.inf)
        limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
        c.jt = solve_row(c.a, c.b, tangent, 0.0, c.jt, -limit, limit)

    def step(self, dt):
        moving = [b for b in self.bodies if not b.is_static]
        keep = np.exp(-np.array((self.linear_damping, self.angular_damping)) * dt).tolist()
        for b in moving:
            b.vel = (b.vel + self.gravity * dt) * keep[0]
            b.omega *= keep[1]
        self.contacts = self.find_contacts()
        for c in self.contacts:
            closing = -float(self.rows(c)[0] @ velocities(c.a, c.b))
            bounce = min(c.a.restitution, c.b.restitution) * closing if closing > RESTING_SPEED else 0.0
            c.target = max(bounce, BETA / dt * max(c.depth - SLOP, 0.0))
        for joint in self.joints:
            joint.prepare(dt)
        for _ in range(ITERATIONS):
            for c in self.contacts:
                self.solve_contact(c, dt)
            for joint in self.joints:
                joint.solve()
        for b in moving:
            b.pos = b.pos + b.vel * dt
            b.angle += b.omega * dt
