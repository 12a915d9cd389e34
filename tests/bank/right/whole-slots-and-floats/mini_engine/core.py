"""Bodies of plain floats with __slots__. pos and vel make vectors when somebody asks."""

from math import copysign, exp, hypot, inf, sqrt

from pygame import Vector2

WIDTH, HEIGHT = 900, 600
STEP = 1 / 120
MAX_STEPS = 8
ITERATIONS = 8
BETA = 0.2
SLOP = 0.5
RESTING_SPEED = 30
MAX_BALLS = 40


def cross(a, b):
    return a.x * b.y - a.y * b.x


def spin_velocity(omega, r):
    return Vector2(-omega * r.y, omega * r.x)


class Circle:
    __slots__ = ("radius",)

    def __init__(self, radius):
        if not 0 < radius < inf:
            raise ValueError(f"radius is {radius}")
        self.radius = float(radius)


class Box:
    __slots__ = ("half",)

    def __init__(self, half):
        self.half = Vector2(half)


class Body:
    __slots__ = (
        "shape", "x", "y", "vx", "vy", "angle", "omega", "inv_mass", "inv_inertia", "restitution", "friction", "color",
    )

    def __init__(self, shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(170, 190, 220)):
        self.shape = shape
        self.x, self.y = pos
        self.vx = self.vy = self.angle = self.omega = self.inv_mass = self.inv_inertia = 0.0
        self.restitution = restitution
        self.friction = friction
        self.color = color
        if mass:
            if isinstance(shape, Box):
                raise ValueError("a Box is always static, so its mass must be 0")
            self.inv_mass = 1.0 / mass
            self.inv_inertia = 1.0 / (0.5 * mass * shape.radius * shape.radius)

    @property
    def is_static(self):
        return self.inv_mass == 0.0

    @property
    def pos(self):
        return Vector2(self.x, self.y)

    @pos.setter
    def pos(self, value):
        self.x, self.y = value

    @property
    def vel(self):
        return Vector2(self.vx, self.vy)

    @vel.setter
    def vel(self, value):
        self.vx, self.vy = value


class Contact:
    __slots__ = ("a", "b", "nx", "ny", "depth", "px", "py", "jn", "jt", "target")

    def __init__(self, a, b, normal, depth, point):
        self.a = a
        self.b = b
        self.nx, self.ny = normal
        self.depth = depth
        self.px, self.py = point
        self.jn = self.jt = self.target = 0.0

    normal = property(lambda self: Vector2(self.nx, self.ny))
    point = property(lambda self: Vector2(self.px, self.py))

    def speed(self, x, y):
        """Speed of B away from A at the point, along (x, y)."""
        a, b = self.a, self.b
        vx = b.vx - b.omega * (self.py - b.y) - a.vx + a.omega * (self.py - a.y)
        vy = b.vy + b.omega * (self.px - b.x) - a.vy - a.omega * (self.px - a.x)
        return vx * x + vy * y

    def softness(self, x, y):
        a, b = self.a, self.b
        la = (self.px - a.x) * y - (self.py - a.y) * x
        lb = (self.px - b.x) * y - (self.py - b.y) * x
        return a.inv_mass + b.inv_mass + la * la * a.inv_inertia + lb * lb * b.inv_inertia

    def push(self, ix, iy):
        a, b = self.a, self.b
        a.vx -= ix * a.inv_mass
        a.vy -= iy * a.inv_mass
        a.omega -= ((self.px - a.x) * iy - (self.py - a.y) * ix) * a.inv_inertia
        b.vx += ix * b.inv_mass
        b.vy += iy * b.inv_mass
        b.omega += ((self.px - b.x) * iy - (self.py - b.y) * ix) * b.inv_inertia


def circle_circle(a, b):
    dx, dy = b.x - a.x, b.y - a.y
    d = hypot(dx, dy)
    reach = a.shape.radius + b.shape.radius
    if d >= reach:
        return None
    nx, ny = (dx / d, dy / d) if d > 0 else (0.0, 1.0)
    return Contact(a, b, (nx, ny), reach - d, (a.x + nx * a.shape.radius, a.y + ny * a.shape.radius))


def circle_box(a, b):
    w, h = b.shape.half
    r = a.shape.radius
    dx, dy = a.x - b.x, a.y - b.y
    over_x, over_y = abs(dx) - w, abs(dy) - h
    if over_x <= 0 and over_y <= 0:
        if over_x > over_y:
            s = copysign(1.0, dx)
            return Contact(a, b, (-s, 0.0), r - over_x, (b.x + s * w, a.y))
        s = copysign(1.0, dy)
        return Contact(a, b, (0.0, -s), r - over_y, (a.x, b.y + s * h))
    qx = b.x + min(w, max(-w, dx))
    qy = b.y + min(h, max(-h, dy))
    d = hypot(qx - a.x, qy - a.y)
    if d >= r:
        return None
    return Contact(a, b, ((qx - a.x) / d, (qy - a.y) / d), r - d, (qx, qy))


def collide(a, b):
    if isinstance(a.shape, Box):
        if isinstance(b.shape, Box):
            return None
        return circle_box(b, a)
    if isinstance(b.shape, Box):
        return circle_box(a, b)
    return circle_circle(a, b)


def apply_impulse(a, b, impulse, ra, rb):
    a.vx -= impulse.x * a.inv_mass
    a.vy -= impulse.y * a.inv_mass
    a.omega -= cross(ra, impulse) * a.inv_inertia
    b.vx += impulse.x * b.inv_mass
    b.vy += impulse.y * b.inv_mass
    b.omega += cross(rb, impulse) * b.inv_inertia


def effective_mass(a, b, ra, rb, axis):
    return a.inv_mass + b.inv_mass + cross(ra, axis) ** 2 * a.inv_inertia + cross(rb, axis) ** 2 * b.inv_inertia


class DistanceJoint:
    __slots__ = ("a", "b", "length", "axis", "bias", "k")

    def __init__(self, a, b):
        self.a = a
        self.b = b
        self.length = hypot(b.x - a.x, b.y - a.y)
        self.axis = Vector2(0, 1)
        self.bias = 0.0
        self.k = 0.0

    def prepare(self, dt):
        dx, dy = self.b.x - self.a.x, self.b.y - self.a.y
        d = hypot(dx, dy)
        self.axis = Vector2(dx / d, dy / d) if d else Vector2(0, 1)
        self.bias = BETA / dt * (self.length - d)
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        if not self.k:
            return
        a, b, (x, y) = self.a, self.b, self.axis
        p = (self.bias - (b.vx - a.vx) * x - (b.vy - a.vy) * y) / self.k
        a.vx -= p * x * a.inv_mass
        a.vy -= p * y * a.inv_mass
        b.vx += p * x * b.inv_mass
        b.vy += p * y * b.inv_mass


class World:
    __slots__ = ("gravity", "linear_damping", "angular_damping", "bodies", "joints", "contacts")

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
        contacts = []
        bodies = self.bodies
        for i in range(1, len(bodies)):
            for j in range(i):
                if bodies[i].inv_mass or bodies[j].inv_mass:
                    c = collide(bodies[j], bodies[i])
                    if c:
                        contacts.append(c)
        return contacts

    def solve_contact(self, c, dt):
        x, y = c.nx, c.ny
        old = c.jn
        c.jn = max(0.0, old + (c.target - c.speed(x, y)) / c.softness(x, y))
        c.push(x * (c.jn - old), y * (c.jn - old))
        limit = sqrt(c.a.friction * c.b.friction) * c.jn
        old = c.jt
        c.jt = min(limit, max(-limit, old - c.speed(-y, x) / c.softness(-y, x)))
        c.push(-y * (c.jt - old), x * (c.jt - old))

    def step(self, dt):
        gx, gy = self.gravity
        keep = exp(-self.linear_damping * dt)
        keep_spin = exp(-self.angular_damping * dt)
        for b in self.bodies:
            if b.inv_mass:
                b.vx = (b.vx + gx * dt) * keep
                b.vy = (b.vy + gy * dt) * keep
                b.omega *= keep_spin
        self.contacts = self.find_contacts()
        for c in self.contacts:
            vn = c.speed(c.nx, c.ny)
            c.target = BETA / dt * max(c.depth - SLOP, 0.0)
            if vn < -RESTING_SPEED:
                c.target = max(c.target, -min(c.a.restitution, c.b.restitution) * vn)
        for j in self.joints:
            j.prepare(dt)
        for _ in range(ITERATIONS):
            for c in self.contacts:
                self.solve_contact(c, dt)
            for j in self.joints:
                j.solve()
        for b in self.bodies:
            if b.inv_mass:
                b.x += b.vx * dt
                b.y += b.vy * dt
                b.angle += b.omega * dt
