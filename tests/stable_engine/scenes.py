"""The scenes of the battery, as plain data. Lengths in px, times in s, masses in kg."""

import math
import random
from dataclasses import dataclass, field

from stable_engine import (
    Body,
    Bounce,
    Box,
    Bullets,
    Circle,
    Contacts,
    Friction,
    Rod,
    Rods,
    Spring,
    Springs,
    World,
)

G = 980.0  # px/s²
DT = 1 / 120  # s, with 4 substeps: h = 1/480
NO_GRAVITY = (0.0, 0.0)


@dataclass
class Ball:
    """A disc; mass 0 makes it static."""

    pos: tuple[float, float]
    radius: float = 10.0
    mass: float = 1.0
    vel: tuple[float, float] = (0.0, 0.0)
    omega: float = 0.0
    restitution: float = 0.0
    friction: float = 0.6
    bullet: bool = False


@dataclass
class Block:
    """A static box."""

    pos: tuple[float, float]
    half: tuple[float, float]
    restitution: float = 0.0
    friction: float = 0.6


@dataclass
class Scene:
    """Joints name the bodies they tie by their place in the list."""

    bodies: list[Ball | Block]
    rods: list[tuple[int, int]] = field(default_factory=list)
    springs: list[tuple[int, int, float]] = field(default_factory=list)  # a, b, stiffness
    gravity: tuple[float, float] = (0.0, G)


def build(scene, effects=None, substeps=4):
    """The scene in the stable engine, with contacts, friction, bounce, and what else it needs."""
    if effects is None:
        effects = [Contacts(), Friction(), Bounce()]
        effects += [Rods()] if scene.rods else []
        effects += [Springs()] if scene.springs else []
        effects += [Bullets()] if any(getattr(b, "bullet", False) for b in scene.bodies) else []
    world = World(gravity=scene.gravity, substeps=substeps, effects=effects)
    bodies = [world.add(body(data)) for data in scene.bodies]
    for a, b in scene.rods:
        world.add(Rod(bodies[a], bodies[b]))
    for a, b, stiffness in scene.springs:
        world.add(Spring(bodies[a], bodies[b], stiffness))
    return world


def body(data):
    surface = {"restitution": data.restitution, "friction": data.friction}
    if isinstance(data, Block):
        return Body(Box(data.half), data.pos, **surface)
    made = Body(Circle(data.radius), data.pos, data.mass, bullet=data.bullet, **surface)
    made.vel, made.omega = data.vel, data.omega
    return made


def floor(y=0.0, **surface):
    """A floor whose surface lies at y."""
    return Block((0, y + 500), (5000, 500), **surface)


def slot(width, height, thick=20.0):
    """A floor at 0 and two walls, width px apart, around x = 0."""
    side = width / 2 + thick
    return [
        Block((0, thick), (width / 2 + 2 * thick, thick)),
        Block((-side, -height / 2), (thick, height / 2)),
        Block((side, -height / 2), (thick, height / 2)),
    ]


def tower(count=20, radius=10.0):
    """Equal balls on top of each other in a slot that just lets them through."""
    balls = [Ball((0, -radius * (2 * i + 1)), radius) for i in range(count)]
    return Scene([*slot(2 * radius, 2 * radius * (count + 5)), *balls])


def heavy_on_light(ratio):
    """A ball of ratio times the mass on top of a light one, in a slot."""
    return Scene([*slot(40, 400), Ball((0, -20), 20), Ball((0, -60), 20, mass=ratio)])


def pendulum(angle=90.0, length=140.0):
    """A bob on a rod, let go at an angle from the vertical in degrees."""
    turn = math.radians(angle)
    bob = Ball((length * math.sin(turn), length * math.cos(turn)), 24, mass=6)
    return Scene([Ball((0, 0), 6, mass=0), bob], rods=[(0, 1)])


def chain(links, step, bob=1.0):
    """Balls on rods, hung from a peg, each one step further; the last has mass bob."""
    balls = [Ball((step[0] * i, step[1] * i), 4) for i in range(1, links + 1)]
    balls[-1].mass = bob
    return Scene([Ball((0, 0), 4, mass=0), *balls], rods=[(i, i + 1) for i in range(links)])


def pile(count=200, width=300.0, seed=1):
    """Balls of several sizes rained into a bin."""
    rng = random.Random(seed)
    columns = int(width // 26)
    balls = []
    for i in range(count):
        row, column = divmod(i, columns)
        radius = rng.uniform(8, 12)
        pos = (26 * (column + 0.5) - width / 2 + rng.uniform(-0.5, 0.5), -26 * row - 14)
        balls.append(Ball(pos, radius, mass=radius**2 / 100))
    return Scene([*slot(width, 26 * (count / columns + 5), 50), *balls])


def cradle(gap, count=5, speed=300.0):
    """Equal balls in a row without gravity, the first on its way to the others."""
    row = [Ball((i * (20 + gap), 0), restitution=1.0, friction=0.0) for i in range(count - 1)]
    first = Ball((-60, 0), vel=(speed, 0), restitution=1.0, friction=0.0)
    return Scene([first, *row], gravity=NO_GRAVITY)


def closed_box(seed):
    """A box filled by 55 % with balls of up to 1000:1 in mass, some in pairs on rods, all flying."""
    rng = random.Random(seed)
    half = 150.0
    walls = [
        Block((0, half + 50), (half + 100, 50)),
        Block((0, -half - 50), (half + 100, 50)),
        Block((half + 50, 0), (50, half + 100)),
        Block((-half - 50, 0), (50, half + 100)),
    ]
    balls = []
    filled = 0.0
    while filled < 0.55 * (2 * half) ** 2:
        radius = rng.uniform(6, 22)
        reach = half - radius
        pos = (rng.uniform(-reach, reach), rng.uniform(-reach, reach))
        vel = (rng.uniform(-400, 400), rng.uniform(-400, 400))
        mass, bounce = 10 ** rng.uniform(-1.5, 1.5), rng.uniform(0, 0.9)
        balls.append(Ball(pos, radius, mass, vel, 0.0, bounce, rng.uniform(0, 1)))
        filled += math.pi * radius**2
    first = len(walls)
    rods = [(first + 2 * i, first + 2 * i + 1) for i in range(min(4, len(balls) // 2))]
    return Scene([*walls, *balls], rods)
