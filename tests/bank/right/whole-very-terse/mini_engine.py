"""Tiny engine. px, s, rad; y down."""
import math, random
from itertools import combinations
import pygame
from pygame import Vector2 as V
from lab_runtime import frame_budget

WIDTH, HEIGHT = 900, 600
STEP = 1 / 120
MAX_STEPS = ITERATIONS = 8
BETA, SLOP, RESTING_SPEED, MAX_BALLS = 0.2, 0.5, 30, 40
GREY = 84, 90, 104

cross = lambda a, b: a.x * b.y - a.y * b.x
spin_velocity = lambda omega, r: V(-omega * r.y, omega * r.x)


class Circle:
    def __init__(self, radius): self.radius = radius


class Box:
    def __init__(self, half): self.half = V(half)


class Body:
    is_static = property(lambda s: s.inv_mass == 0)

    def __init__(self, shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(170, 190, 220)):
        if mass and isinstance(shape, Box): raise ValueError("boxes are static")
        self.shape, self.pos, self.vel, self.angle, self.omega = shape, V(pos), V(), 0.0, 0.0
        self.restitution, self.friction, self.color = restitution, friction, color
        self.inv_mass = 1 / mass if mass else 0.0
        self.inv_inertia = 2 / (mass * shape.radius**2) if mass else 0.0


class Contact:
    def __init__(self, a, b, normal, depth, point):
        self.a, self.b, self.normal, self.depth, self.point = a, b, normal, depth, point
        self.jn = self.jt = self.target = 0.0


def circle_circle(a, b):
    d, r = b.pos - a.pos, a.shape.radius + b.shape.radius
    l = d.length()
    if l >= r: return None
    n = d / l if l else V(0, 1)
    return Contact(a, b, n, r - l, a.pos + n * a.shape.radius)


def circle_box(a, b):
    h, r, p = b.shape.half, a.shape.radius, a.pos
    lo, hi = b.pos - h, b.pos + h
    q = V(min(max(p.x, lo.x), hi.x), min(max(p.y, lo.y), hi.y))
    l = (q - p).length()
    if l >= r: return None
    if l: return Contact(a, b, (q - p) / l, r - l, q)
    g, n = min([(p.x - lo.x, 0), (hi.x - p.x, 1), (p.y - lo.y, 2), (hi.y - p.y, 3)])
    n = V([(1, 0), (-1, 0), (0, 1), (0, -1)][n])
    return Contact(a, b, n, r + g, p - n * g)


def collide(a, b):
    ca, cb = isinstance(a.shape, Circle), isinstance(b.shape, Circle)
    return circle_circle(a, b) if ca and cb else circle_box(a, b) if ca else circle_box(b, a) if cb else None


def apply_impulse(a, b, impulse, ra, rb):
    for s, o, r in (-1, a, ra), (1, b, rb):
        o.vel += s * o.inv_mass * impulse
        o.omega += s * o.inv_inertia * cross(r, impulse)


def effective_mass(a, b, ra, rb, axis):
    return a.inv_mass + b.inv_mass + cross(ra, axis)**2 * a.inv_inertia + cross(rb, axis)**2 * b.inv_inertia


def slip(c, axis):
    ra, rb = c.point - c.a.pos, c.point - c.b.pos
    return (c.b.vel + spin_velocity(c.b.omega, rb) - c.a.vel - spin_velocity(c.a.omega, ra)) * axis, ra, rb


class DistanceJoint:
    def __init__(self, a, b):
        self.a, self.b, self.length = a, b, a.pos.distance_to(b.pos)
        self.axis, self.bias, self.k = V(0, 1), 0.0, 0.0

    def prepare(self, dt):
        d = self.b.pos - self.a.pos
        l = d.length()
        self.axis = d / l if l else V(0, 1)
        self.bias, self.k = BETA / dt * (self.length - l), self.a.inv_mass + self.b.inv_mass

    def solve(self):
        if self.k: apply_impulse(self.a, self.b, (self.bias - (self.b.vel - self.a.vel) * self.axis) / self.k * self.axis, V(), V())


class World:
    def __init__(self, gravity=(0, 980), linear_damping=0.05, angular_damping=0.3):
        self.gravity, self.linear_damping, self.angular_damping = V(gravity), linear_damping, angular_damping
        self.bodies, self.joints, self.contacts = [], [], []

    def add(self, body):
        self.bodies.append(body)
        return body

    def find_contacts(self):
        return [c for a, b in combinations(self.bodies, 2) if not (a.is_static and b.is_static) and (c := collide(a, b))]

    def solve_contact(self, c, dt):
        n = c.normal
        t = V(-n.y, n.x)
        v, ra, rb = slip(c, n)
        old, c.jn = c.jn, max(0.0, c.jn + (c.target - v) / effective_mass(c.a, c.b, ra, rb, n))
        apply_impulse(c.a, c.b, (c.jn - old) * n, ra, rb)
        v, old, m = slip(c, t)[0], c.jt, math.sqrt(c.a.friction * c.b.friction) * c.jn
        c.jt = max(-m, min(m, old - v / effective_mass(c.a, c.b, ra, rb, t)))
        apply_impulse(c.a, c.b, (c.jt - old) * t, ra, rb)

    def step(self, dt):
        moving = [b for b in self.bodies if not b.is_static]
        for b in moving:
            b.vel = (b.vel + self.gravity * dt) * math.exp(-self.linear_damping * dt)
            b.omega *= math.exp(-self.angular_damping * dt)
        self.contacts = self.find_contacts()
        for c in self.contacts:
            v = -slip(c, c.normal)[0]
            c.target = max(min(c.a.restitution, c.b.restitution) * v * (v > RESTING_SPEED), BETA / dt * max(c.depth - SLOP, 0))
        for j in self.joints: j.prepare(dt)
        for _ in range(ITERATIONS):
            for c in self.contacts: self.solve_contact(c, dt)
            for j in self.joints: j.solve()
        for b in moving:
            b.pos += b.vel * dt
            b.angle += b.omega * dt


def ball(rng, pos):
    r = rng.randint(10, 22)
    return Body(Circle(r), pos, r * r / 100, 0.4, 0.6, tuple(rng.randint(90, 240) for _ in "rgb"))


def make_world(rng):
    w = World()
    for p, h in ((450, 580), (450, 20)), ((-20, 300), (20, 300)), ((920, 300), (20, 300)), ((200, 260), (150, 10)):
        w.add(Body(Box(h), p, color=GREY))
    for i in range(5): w.add(Body(Circle(8), (375 + 60 * i, 400), color=GREY))
    w.joints.append(DistanceJoint(w.add(Body(Circle(6), (700, 90), color=GREY)), w.add(Body(Circle(24), (840, 90), 6, 0.2))))
    for i in range(8): w.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return w


def advance(world, accumulator, frame_seconds):
    n, rest = divmod(accumulator + min(frame_seconds, MAX_STEPS * STEP), STEP)
    for _ in range(int(n)): world.step(STEP)
    return rest, int(n)


def main():
    pygame.init()
    screen, font, clock = pygame.display.set_mode((WIDTH, HEIGHT)), pygame.font.Font(None, 26), pygame.time.Clock()
    rng = random.Random(12)
    w, acc, n, on = make_world(rng), 0.0, 0, True
    while on and frame_budget():
        seconds = clock.tick(60) / 1000
        for e in pygame.event.get():
            if e.type == pygame.QUIT: on = False
            if e.type == pygame.MOUSEBUTTONDOWN and e.button == 1 and sum(not b.is_static for b in w.bodies) < MAX_BALLS: w.add(ball(rng, e.pos))
            if e.type == pygame.KEYDOWN and e.key == pygame.K_r: w = make_world(rng := random.Random(12))
        acc, k = advance(w, acc, seconds)
        n += k
        screen.fill((22, 25, 33))
        for j in w.joints: pygame.draw.line(screen, "white", j.a.pos, j.b.pos, 3)
        for b in w.bodies:
            if isinstance(b.shape, Box): pygame.draw.rect(screen, b.color, (b.pos - b.shape.half, b.shape.half * 2))
            else:
                pygame.draw.circle(screen, b.color, b.pos, b.shape.radius)
                if not b.is_static: pygame.draw.line(screen, "black", b.pos, b.pos + V(b.shape.radius, 0).rotate_rad(b.angle), 3)
        screen.blit(font.render(f"moving: {sum(not b.is_static for b in w.bodies)} contacts: {len(w.contacts)}", True, "white"), (12, 10))
        pygame.display.flip()
    pygame.quit()
    j = w.joints[0]
    print(f"Fixed steps: {n}\nPendulum length error: {abs(j.a.pos.distance_to(j.b.pos) - j.length):.2f} px")


if __name__ == "__main__": main()
