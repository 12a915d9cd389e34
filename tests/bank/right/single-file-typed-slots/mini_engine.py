"""Mini engine, typed throughout, on plain floats in __slots__."""

import math
import os
import random
from collections.abc import Iterator, Sequence
from typing import Any, ClassVar, Final, Optional, Protocol, TypeAlias, Union

import pygame
from pygame.math import Vector2 as V

WIDTH: Final[int] = 900
HEIGHT: Final[int] = 600
STEP: Final[float] = 1 / 120
MAX_STEPS: Final[int] = 8
ITERATIONS: Final[int] = 8
BETA: Final[float] = 0.2
SLOP: Final[float] = 0.5
RESTING_SPEED: Final[float] = 30.0
MAX_BALLS: Final[int] = 40
SEED: Final[int] = int(os.environ.get("MINI_ENGINE_SEED", "12"))

Pair: TypeAlias = Union[V, Sequence[float]]
Colour: TypeAlias = tuple[int, int, int]


class HasXY(Protocol):
    x: float
    y: float


def cross(a: HasXY, b: HasXY) -> float:
    return a.x * b.y - a.y * b.x


def spin_velocity(omega: float, r: HasXY) -> V:
    return V(-omega * r.y, omega * r.x)


class Circle:
    __slots__ = ("radius",)

    def __init__(self, radius: float) -> None:
        self.radius: float = float(radius)


class Box:
    __slots__ = ("half",)

    def __init__(self, half: Pair) -> None:
        self.half: V = V(half)


Shape: TypeAlias = Union[Circle, Box]


class Body:
    __slots__ = (
        "shape", "x", "y", "vx", "vy", "angle", "omega",
        "inv_mass", "inv_inertia", "restitution", "friction", "color",
    )  # fmt: skip

    def __init__(
        self,
        shape: Shape,
        pos: Pair,
        mass: float = 0.0,
        restitution: float = 0.3,
        friction: float = 0.6,
        color: Colour = (150, 150, 160),
    ) -> None:
        if isinstance(shape, Box) and mass != 0.0:
            raise ValueError("mass: a Box is static, its mass must be 0")
        self.shape: Shape = shape
        self.x, self.y = map(float, pos)
        self.vx: float = 0.0
        self.vy: float = 0.0
        self.angle: float = 0.0
        self.omega: float = 0.0
        self.restitution: float = restitution
        self.friction: float = friction
        self.color: Colour = color
        self.inv_mass: float = 0.0
        self.inv_inertia: float = 0.0
        if isinstance(shape, Circle) and mass > 0.0:
            self.inv_mass = 1.0 / mass
            self.inv_inertia = self.inv_mass / (0.5 * shape.radius * shape.radius)

    @property
    def pos(self) -> V:
        return V(self.x, self.y)

    @pos.setter
    def pos(self, value: Pair) -> None:
        self.x, self.y = map(float, value)

    @property
    def vel(self) -> V:
        return V(self.vx, self.vy)

    @vel.setter
    def vel(self, value: Pair) -> None:
        self.vx, self.vy = map(float, value)

    @property
    def is_static(self) -> bool:
        return self.inv_mass == 0.0

    def push(self, jx: float, jy: float, rx: float, ry: float) -> None:
        self.vx += jx * self.inv_mass
        self.vy += jy * self.inv_mass
        self.omega += (rx * jy - ry * jx) * self.inv_inertia


class Contact:
    __slots__ = ("a", "b", "normal", "depth", "point", "jn", "jt", "target")

    def __init__(self, a: Body, b: Body, normal: V, depth: float, point: V) -> None:
        self.a: Body = a
        self.b: Body = b
        self.normal: V = normal
        self.depth: float = depth
        self.point: V = point
        self.jn: float = 0.0
        self.jt: float = 0.0
        self.target: float = 0.0


def circle_circle(a: Body, b: Body) -> Optional[Contact]:
    dx, dy = b.x - a.x, b.y - a.y
    reach: float = a.shape.radius + b.shape.radius
    far: float = math.hypot(dx, dy)
    if far >= reach:
        return None
    nx, ny = (dx / far, dy / far) if far > 0.0 else (0.0, 1.0)
    r: float = a.shape.radius
    return Contact(a, b, V(nx, ny), reach - far, V(a.x + nx * r, a.y + ny * r))


def circle_box(a: Body, b: Body) -> Optional[Contact]:
    r, hx, hy = a.shape.radius, b.shape.half.x, b.shape.half.y
    px: float = min(max(a.x, b.x - hx), b.x + hx)
    py: float = min(max(a.y, b.y - hy), b.y + hy)
    if (px, py) == (a.x, a.y):
        return leave(a, b, a.x - b.x, a.y - b.y, hx, hy)
    far: float = math.hypot(px - a.x, py - a.y)
    if far >= r:
        return None
    return Contact(a, b, V((px - a.x) / far, (py - a.y) / far), r - far, V(px, py))


def leave(a: Body, b: Body, dx: float, dy: float, hx: float, hy: float) -> Contact:
    right, left, down, up = hx - dx, hx + dx, hy - dy, hy + dy
    nearest: float = min(right, left, down, up)
    out: V = {right: V(1, 0), left: V(-1, 0), down: V(0, 1), up: V(0, -1)}[nearest]
    return Contact(a, b, -out, a.shape.radius + nearest, a.pos + nearest * out)


def collide(a: Body, b: Body) -> Optional[Contact]:
    first: bool = isinstance(a.shape, Circle)
    second: bool = isinstance(b.shape, Circle)
    if first and second:
        return circle_circle(a, b)
    if first:
        return circle_box(a, b)
    if second:
        return circle_box(b, a)
    return None


def apply_impulse(a: Body, b: Body, impulse: HasXY, ra: HasXY, rb: HasXY) -> None:
    a.push(-impulse.x, -impulse.y, ra.x, ra.y)
    b.push(impulse.x, impulse.y, rb.x, rb.y)


def effective_mass(a: Body, b: Body, ra: HasXY, rb: HasXY, axis: HasXY) -> float:
    ta: float = cross(ra, axis)
    tb: float = cross(rb, axis)
    return a.inv_mass + b.inv_mass + ta * ta * a.inv_inertia + tb * tb * b.inv_inertia


class DistanceJoint:
    __slots__ = ("a", "b", "length", "axis", "bias", "k")

    def __init__(self, a: Body, b: Body) -> None:
        self.a: Body = a
        self.b: Body = b
        self.length: float = math.hypot(b.x - a.x, b.y - a.y)
        self.axis: V = V(0, 1)
        self.bias: float = 0.0
        self.k: float = 0.0

    def prepare(self, dt: float) -> None:
        dx, dy = self.b.x - self.a.x, self.b.y - self.a.y
        far: float = math.hypot(dx, dy)
        if far > 0.0:
            self.axis = V(dx / far, dy / far)
        self.bias = -BETA / dt * (far - self.length)
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self) -> None:
        if self.k <= 0.0:
            return
        nx, ny = self.axis
        along: float = (self.b.vx - self.a.vx) * nx + (self.b.vy - self.a.vy) * ny
        j: float = (self.bias - along) / self.k
        self.a.push(-j * nx, -j * ny, 0.0, 0.0)
        self.b.push(j * nx, j * ny, 0.0, 0.0)


class World:
    made: ClassVar[int] = 0

    def __init__(
        self,
        gravity: Pair = (0, 980),
        linear_damping: float = 0.05,
        angular_damping: float = 0.3,
    ) -> None:
        self.gravity: V = V(gravity)
        self.linear_damping: float = linear_damping
        self.angular_damping: float = angular_damping
        self.bodies: list[Body] = []
        self.joints: list[DistanceJoint] = []
        self.contacts: list[Contact] = []
        World.made += 1

    def add(self, body: Body) -> Body:
        self.bodies.append(body)
        return body

    def moving(self) -> Iterator[Body]:
        return (body for body in self.bodies if body.inv_mass)

    def find_contacts(self) -> list[Contact]:
        found: list[Contact] = []
        for i, a in enumerate(self.bodies):
            for b in self.bodies[i + 1 :]:
                if a.inv_mass or b.inv_mass:
                    contact = collide(a, b)
                    if contact:
                        found.append(contact)
        return found

    @staticmethod
    def slip(c: Contact, nx: float, ny: float) -> float:
        a, b = c.a, c.b
        vx = b.vx - b.omega * (c.point.y - b.y) - a.vx + a.omega * (c.point.y - a.y)
        vy = b.vy + b.omega * (c.point.x - b.x) - a.vy - a.omega * (c.point.x - a.x)
        return vx * nx + vy * ny

    def solve_contact(self, c: Contact, dt: float) -> None:
        a, b, n = c.a, c.b, c.normal
        t: V = V(-n.y, n.x)
        ra, rb = c.point - a.pos, c.point - b.pos
        jn: float = c.jn + (c.target - self.slip(c, n.x, n.y)) / effective_mass(a, b, ra, rb, n)
        if jn < 0.0:
            jn = 0.0
        apply_impulse(a, b, n * (jn - c.jn), ra, rb)
        c.jn = jn
        limit: float = (a.friction * b.friction) ** 0.5 * jn
        jt: float = c.jt - self.slip(c, t.x, t.y) / effective_mass(a, b, ra, rb, t)
        jt = -limit if jt < -limit else limit if jt > limit else jt
        apply_impulse(a, b, t * (jt - c.jt), ra, rb)
        c.jt = jt

    def forces(self, dt: float) -> None:
        slower: float = math.exp(-dt * self.linear_damping)
        calmer: float = math.exp(-dt * self.angular_damping)
        for body in self.moving():
            body.vx = (body.vx + self.gravity.x * dt) * slower
            body.vy = (body.vy + self.gravity.y * dt) * slower
            body.omega *= calmer

    def solve(self, dt: float) -> None:
        for c in self.contacts:
            closing: float = -self.slip(c, c.normal.x, c.normal.y)
            c.target = max(0.0, c.depth - SLOP) * BETA / dt
            if closing > RESTING_SPEED:
                c.target = max(c.target, min(c.a.restitution, c.b.restitution) * closing)
        for joint in self.joints:
            joint.prepare(dt)
        for _ in range(ITERATIONS):
            for c in self.contacts:
                self.solve_contact(c, dt)
            for joint in self.joints:
                joint.solve()

    def step(self, dt: float) -> None:
        self.forces(dt)
        self.contacts = self.find_contacts()
        self.solve(dt)
        for body in self.moving():
            body.x += body.vx * dt
            body.y += body.vy * dt
            body.angle += body.omega * dt


def ball(rng: random.Random, pos: Pair) -> Body:
    radius: int = rng.randint(10, 22)
    hue: Colour = (rng.randint(60, 255), rng.randint(60, 255), rng.randint(60, 255))
    return Body(Circle(radius), pos, radius * radius / 100, 0.4, 0.6, hue)


def make_world(rng: random.Random) -> World:
    world: World = World()
    boxes: list[tuple[Pair, Pair]] = [
        ((450, 20), (450, 580)),
        ((20, 300), (-20, 300)),
        ((20, 300), (920, 300)),
        ((150, 10), (200, 260)),
    ]
    for half, at in boxes:
        world.add(Body(Box(half), at))
    for i in range(5):
        world.add(Body(Circle(8), (375 + 60 * i, 400)))
    hook: Body = world.add(Body(Circle(6), (700, 90)))
    bob: Body = world.add(Body(Circle(24), (840, 90), 6.0, 0.2))
    world.joints.append(DistanceJoint(hook, bob))
    for i in range(8):
        world.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return world


class App:
    __slots__ = ("screen", "font", "clock", "rng", "world", "accumulator", "steps", "running")

    def __init__(self) -> None:
        pygame.init()
        self.screen: pygame.Surface = pygame.display.set_mode((WIDTH, HEIGHT))
        self.font: pygame.font.Font = pygame.font.Font(None, 26)
        self.clock: pygame.time.Clock = pygame.time.Clock()
        self.accumulator: float = 0.0
        self.steps: int = 0
        self.running: bool = True
        self.reset()

    def reset(self) -> None:
        self.rng: random.Random = random.Random(SEED)
        self.world: World = make_world(self.rng)

    def on(self, event: Any) -> None:
        match event.type:
            case pygame.QUIT:
                self.running = False
            case pygame.MOUSEBUTTONDOWN if event.button == 1:
                if sum(1 for _ in self.world.moving()) < MAX_BALLS:
                    self.world.add(ball(self.rng, event.pos))
            case pygame.KEYDOWN if event.key == pygame.K_r:
                self.reset()

    def advance(self, seconds: float) -> None:
        self.accumulator += min(seconds, MAX_STEPS * STEP)
        while self.accumulator >= STEP:
            self.world.step(STEP)
            self.accumulator -= STEP
            self.steps += 1

    def draw(self) -> None:
        self.screen.fill((18, 18, 24))
        for joint in self.world.joints:
            pygame.draw.line(self.screen, (230, 230, 230), joint.a.pos, joint.b.pos, 2)
        for body in self.world.bodies:
            if isinstance(body.shape, Box):
                pygame.draw.rect(self.screen, body.color, (body.pos - body.shape.half, body.shape.half * 2))
            else:
                pygame.draw.circle(self.screen, body.color, body.pos, body.shape.radius)
                if not body.is_static:
                    spoke: V = V(body.shape.radius, 0).rotate_rad(body.angle)
                    pygame.draw.line(self.screen, (18, 18, 24), body.pos, body.pos + spoke, 2)
        text: str = f"moving {sum(1 for _ in self.world.moving())}, contacts {len(self.world.contacts)}"
        self.screen.blit(self.font.render(text, True, (230, 230, 230)), (10, 10))
        pygame.display.update()

    def run(self) -> None:
        while self.running:
            self.clock.tick(60)
            for event in pygame.event.get():
                self.on(event)
            self.advance(self.clock.get_time() / 1000.0)
            self.draw()
        rod: DistanceJoint = self.world.joints[0]
        error: float = abs((rod.a.pos - rod.b.pos).magnitude() - rod.length)
        print(f"Number of fixed steps = {self.steps}")
        print(f"Pendulum length error: {error:.2f} px")
        pygame.quit()


def main() -> None:
    App().run()


if __name__ == "__main__":
    main()
