import math
from pygame.math import Vector2 as V

WIDTH, HEIGHT = 900, 600
STEP = 1 / 120
MAX_STEPS = 8
ITERATIONS = 8
BETA = 0.2
SLOP = 0.5
RESTING_SPEED = 30
MAX_BALLS = 40

def cross(a, b): return a.x * b.y - a.y * b.x
def spin_velocity(omega, r): return V(-omega * r.y, omega * r.x)

class Circle:
    def __init__(self, radius): self.radius = radius

class Box:
    def __init__(self, half): self.half = V(half)

class Body:
    def __init__(self, shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(160, 160, 160)):
        if isinstance(shape, Box) and mass: raise ValueError("boxes are static")
        self.shape, self.pos, self.vel = shape, V(pos), V()
        self.angle = self.omega = 0.0
        self.restitution, self.friction, self.color = restitution, friction, color
        self.inv_mass = 1 / mass if mass else 0.0
        self.inv_inertia = 2 / (mass * shape.radius ** 2) if mass else 0.0
    is_static = property(lambda self: not self.inv_mass)
    def velocity_at(self, r): return self.vel + spin_velocity(self.omega, r)
    def kick(self, impulse, r):
        self.vel = self.vel + impulse * self.inv_mass
        self.omega += cross(r, impulse) * self.inv_inertia

class Contact:
    jn = jt = target = 0.0
    def __init__(self, a, b, normal, depth, point):
        self.a, self.b, self.normal, self.depth, self.point = a, b, normal, depth, point

def circle_circle(a, b):
    d, r = b.pos - a.pos, a.shape.radius + b.shape.radius
    if d.length() >= r: return None
    n = d.normalize() if d.length() > 0 else V(0, 1)
    return Contact(a, b, n, r - d.length(), a.pos + n * a.shape.radius)

def circle_box(a, b):
    d, h, r = a.pos - b.pos, b.shape.half, a.shape.radius
    if abs(d.x) <= h.x and abs(d.y) <= h.y:
        gap = min(h.x - abs(d.x), h.y - abs(d.y))
        if gap == h.x - abs(d.x): n = V(-1 if d.x > 0 else 1, 0)
        else: n = V(0, -1 if d.y > 0 else 1)
        return Contact(a, b, n, r + gap, a.pos - n * gap)
    q = V(max(-h.x, min(h.x, d.x)), max(-h.y, min(h.y, d.y)))
    gap = math.hypot(q.x - d.x, q.y - d.y)
    return Contact(a, b, (q - d) / gap, r - gap, b.pos + q) if gap < r else None

def collide(a, b):
    if isinstance(b.shape, Circle) and not isinstance(a.shape, Circle): a, b = b, a
    if not isinstance(a.shape, Circle): return None
    return (circle_circle if isinstance(b.shape, Circle) else circle_box)(a, b)

def apply_impulse(a, b, impulse, ra, rb):
    a.kick(-impulse, ra)
    b.kick(impulse, rb)

def effective_mass(a, b, ra, rb, axis):
    return sum(x.inv_mass + cross(r, axis) ** 2 * x.inv_inertia for x, r in ((a, ra), (b, rb)))

class DistanceJoint:
    def __init__(self, a, b):
        self.a, self.b, self.length = a, b, (a.pos - b.pos).length()
    def prepare(self, dt):
        d = self.b.pos - self.a.pos
        self.axis = d / d.length() if d else V(1, 0)
        self.bias = BETA / dt * (self.length - d.length())
        self.k = self.b.inv_mass + self.a.inv_mass
    def solve(self):
        if not self.k: return
        j = (self.bias - (self.b.vel - self.a.vel) * self.axis) / self.k * self.axis
        apply_impulse(self.a, self.b, j, V(), V())

class World:
    def __init__(self, gravity=(0, 980), linear_damping=0.05, angular_damping=0.3):
        self.gravity, self.linear_damping, self.angular_damping = V(gravity), linear_damping, angular_damping
        self.bodies, self.joints, self.contacts = [], [], []
    def add(self, body):
        self.bodies.append(body)
        return body
    def dynamic(self): return [b for b in self.bodies if not b.is_static]
    def find_contacts(self):
        return [c for i, b in enumerate(self.bodies) for a in self.bodies[:i]
                if (a.inv_mass or b.inv_mass) and (c := collide(a, b))]
    def aim(self, c, dt):
        vn = (c.b.velocity_at(c.point - c.b.pos) - c.a.velocity_at(c.point - c.a.pos)) * c.normal
        e = min(c.a.restitution, c.b.restitution) if vn < -RESTING_SPEED else 0
        c.target = max(-e * vn, BETA / dt * max(c.depth - SLOP, 0))
    def solve_contact(self, c, dt):
        a, b = c.a, c.b
        ra, rb = c.point - a.pos, c.point - b.pos
        v = lambda: b.velocity_at(rb) - a.velocity_at(ra)
        before = c.jn
        c.jn = max(0, c.jn + (c.target - v() * c.normal) / effective_mass(a, b, ra, rb, c.normal))
        apply_impulse(a, b, (c.jn - before) * c.normal, ra, rb)
        t = spin_velocity(1, c.normal)
        before, most = c.jt, math.sqrt(a.friction * b.friction) * c.jn
        c.jt = min(most, max(-most, c.jt - v() * t / effective_mass(a, b, ra, rb, t)))
        apply_impulse(a, b, (c.jt - before) * t, ra, rb)
    def step(self, dt):
        slower, calmer = math.exp(-self.linear_damping * dt), math.exp(-self.angular_damping * dt)
        for b in self.dynamic():
            b.vel, b.omega = (b.vel + self.gravity * dt) * slower, b.omega * calmer
        self.contacts = self.find_contacts()
        for c in self.contacts: self.aim(c, dt)
        for j in self.joints: j.prepare(dt)
        for _ in range(ITERATIONS):
            for c in self.contacts: self.solve_contact(c, dt)
            for j in self.joints: j.solve()
        for b in self.dynamic():
            b.pos, b.angle = b.pos + b.vel * dt, b.angle + b.omega * dt

def ball(rng, pos):
    r = rng.randint(10, 22)
    return Body(Circle(r), pos, r * r / 100, 0.4, 0.6, tuple(rng.randrange(80, 250) for _ in "rgb"))

def make_world(rng):
    w = World()
    for x, y, hx, hy in ((450, 580, 450, 20), (-20, 300, 20, 300), (920, 300, 20, 300), (200, 260, 150, 10)):
        w.add(Body(Box((hx, hy)), (x, y)))
    for i in range(5): w.add(Body(Circle(8), (375 + 60 * i, 400)))
    peg, bob = w.add(Body(Circle(6), (700, 90))), w.add(Body(Circle(24), (840, 90), 6, 0.2))
    w.joints += [DistanceJoint(peg, bob)]
    for i in range(8): w.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return w
