"""Everything that computes."""

from functools import partial
from itertools import combinations
from math import exp, sqrt

from pygame import Vector2

from .data import BETA, ITERATIONS, RESTING_SPEED, SLOP, Contact

__all__ = ["cross", "spin_velocity", "circle_circle", "circle_box", "collide", "apply_impulse",
           "effective_mass", "DistanceJoint", "World"]


def cross(a, b):
    return a.cross(b)


def spin_velocity(omega, r):
    return Vector2(-r.y, r.x) * omega


def clamp(x, lo, hi):
    return max(lo, min(x, hi))


def circle_circle(a, b):
    way, reach = b.pos - a.pos, a.shape.radius + b.shape.radius
    dist = way.length()
    n = way / dist if dist > 0 else Vector2(0, 1)
    return Contact(a, b, n, reach - dist, a.pos + n * a.shape.radius) if dist < reach else None


def circle_box(a, b):
    d, h = a.pos - b.pos, b.shape.half
    if abs(d.x) <= h.x and abs(d.y) <= h.y:
        return from_inside(a, b, d, h)
    closest = b.pos + Vector2(clamp(d.x, -h.x, h.x), clamp(d.y, -h.y, h.y))
    way = closest - a.pos
    depth = a.shape.radius - way.length()
    return Contact(a, b, way.normalize(), depth, closest) if depth > 0 else None


def from_inside(a, b, d, h):
    ways = ((h.x - d.x, Vector2(1, 0)), (h.x + d.x, Vector2(-1, 0)), (h.y - d.y, Vector2(0, 1)), (h.y + d.y, Vector2(0, -1)))
    gap, out = min(ways, key=lambda way: way[0])
    return Contact(a, b, -out, a.shape.radius + gap, a.pos + out * gap)


def collide(a, b):
    match a.shape.kind, b.shape.kind:
        case "circle", "circle":
            return circle_circle(a, b)
        case "circle", "box":
            return circle_box(a, b)
        case "box", "circle":
            return circle_box(b, a)
    return None


def apply_impulse(a, b, impulse, ra, rb):
    hit(a, -impulse, ra)
    hit(b, impulse, rb)


def hit(body, impulse, r):
    body.vel += impulse * body.inv_mass
    body.omega += cross(r, impulse) * body.inv_inertia


def softness(body, r, axis):
    return body.inv_mass + cross(r, axis) ** 2 * body.inv_inertia


def effective_mass(a, b, ra, rb, axis):
    return softness(a, ra, axis) + softness(b, rb, axis)


def point_velocity(body, r):
    return body.vel + spin_velocity(body.omega, r)


def speed_along(c, axis):
    return (point_velocity(c.b, c.point - c.b.pos) - point_velocity(c.a, c.point - c.a.pos)).dot(axis)


def bring_to(c, axis, speed, total, bounds):
    """Change the total impulse along axis so that the speed is reached. Returns the new total."""
    ra, rb = c.point - c.a.pos, c.point - c.b.pos
    new = clamp(total + (speed - speed_along(c, axis)) / effective_mass(c.a, c.b, ra, rb, axis), *bounds)
    apply_impulse(c.a, c.b, axis * (new - total), ra, rb)
    return new


def target(c, dt):
    closing = -speed_along(c, c.normal)
    bounce = min(c.a.restitution, c.b.restitution) * closing if closing > RESTING_SPEED else 0
    return max(bounce, BETA / dt * max(c.depth - SLOP, 0))


class DistanceJoint:
    def __init__(self, a, b):
        self.a, self.b = a, b
        self.length = a.pos.distance_to(b.pos)
        self.axis, self.bias, self.k = Vector2(0, 1), 0.0, 0.0

    def prepare(self, dt):
        way = self.b.pos - self.a.pos
        self.axis = way.normalize() if way else Vector2(0, 1)
        self.bias = -BETA / dt * (way.length() - self.length)
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        if self.k:
            impulse = (self.bias - (self.b.vel - self.a.vel).dot(self.axis)) / self.k * self.axis
            self.a.vel -= impulse * self.a.inv_mass
            self.b.vel += impulse * self.b.inv_mass


# stages, each a function of (world, dt)


def forces(world, dt):
    keep, keep_spin = exp(-world.linear_damping * dt), exp(-world.angular_damping * dt)
    for body in moving(world):
        body.vel = keep * (body.vel + world.gravity * dt)
        body.omega = keep_spin * body.omega


def detect(world, dt):
    world.contacts = world.find_contacts()


def solve(world, dt):
    for c in world.contacts:
        c.target = target(c, dt)
    for joint in world.joints:
        joint.prepare(dt)
    passes = [partial(world.solve_contact, c, dt) for c in world.contacts] + [joint.solve for joint in world.joints]
    for one_pass in passes * ITERATIONS:
        one_pass()


def move(world, dt):
    for body in moving(world):
        body.pos += body.vel * dt
        body.angle += body.omega * dt


def moving(world):
    return filter(lambda body: body.inv_mass, world.bodies)


class World:
    stages = (forces, detect, solve, move)

    def __init__(self, gravity=(0, 980), linear_damping=0.05, angular_damping=0.3):
        self.gravity = Vector2(gravity)
        self.linear_damping, self.angular_damping = linear_damping, angular_damping
        self.bodies, self.joints, self.contacts = [], [], []

    def add(self, body):
        self.bodies += [body]
        return body

    def find_contacts(self):
        pairs = ((a, b) for a, b in combinations(self.bodies, 2) if a.inv_mass or b.inv_mass)
        return list(filter(None, (collide(a, b) for a, b in pairs)))

    def solve_contact(self, c, dt):
        c.jn = bring_to(c, c.normal, c.target, c.jn, (0.0, float("inf")))
        limit = sqrt(c.a.friction * c.b.friction) * c.jn
        c.jt = bring_to(c, Vector2(-c.normal.y, c.normal.x), 0.0, c.jt, (-limit, limit))

    def step(self, dt):
        for stage in self.stages:
            stage(self, dt)
