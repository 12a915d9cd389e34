"""The scenes of the battery, as plain data. Lengths in px, times in s, masses in kg, y down."""

import math
import random
from dataclasses import dataclass, field

import stable_engine
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
DT = 1 / 120  # s
SUBSTEPS = 4
H = DT / SUBSTEPS  # 1/480 s


@dataclass
class Ball:
    """A disc. Mass 0 makes it static."""

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
    """Rods and springs name the bodies they tie by their place in the list."""

    bodies: list[Ball | Block]
    rods: list[tuple[int, int]] = field(default_factory=list)
    springs: list[tuple[int, int, float]] = field(default_factory=list)  # a, b, stiffness
    gravity: tuple[float, float] = (0.0, G)


# ---------------------------------------------------------------- into the engine


def effects_of(scene):
    """Contacts, friction, bounce, and whatever else the scene needs."""
    effects = [Contacts(), Friction(), Bounce()]
    if scene.rods:
        effects.append(Rods())
    if scene.springs:
        effects.append(Springs())
    if any(isinstance(data, Ball) and data.bullet for data in scene.bodies):
        effects.append(Bullets())
    return effects


def build(scene, effects=None, substeps=SUBSTEPS):
    """The scene in a world of the stable engine; world.bodies has the scene's order."""
    if effects is None:
        effects = effects_of(scene)
    world = World(gravity=scene.gravity, substeps=substeps, effects=effects)
    bodies = [world.add(make_body(data)) for data in scene.bodies]
    for a, b in scene.rods:
        world.add(Rod(bodies[a], bodies[b]))
    for a, b, stiffness in scene.springs:
        world.add(Spring(bodies[a], bodies[b], stiffness))
    return world


def make_body(data):
    surface = {"restitution": data.restitution, "friction": data.friction}
    if isinstance(data, Block):
        return Body(Box(data.half), data.pos, **surface)
    body = Body(Circle(data.radius), data.pos, data.mass, bullet=data.bullet, **surface)
    body.vel, body.omega = data.vel, data.omega
    return body


# ---------------------------------------------------------------- contacts


def floor(**surface):
    """A floor with its surface at y = 0."""
    return Block((0, 500), (5000, 500), **surface)


def slot(width, height, thick=20.0):
    """A floor with its surface at y = 0, and two walls around x = 0."""
    side = width / 2 + thick
    return [
        Block((0, thick), (width / 2 + 2 * thick, thick)),
        Block((-side, -height / 2), (thick, height / 2)),
        Block((side, -height / 2), (thick, height / 2)),
    ]


def on_floor(radius=10.0, **ball):
    """One ball that touches the floor."""
    return Scene([floor(), Ball((0, -radius), radius, **ball)])


def drop(height, restitution):
    """One ball high above a floor, both with the same restitution."""
    ball = Ball((0, -10 - height), restitution=restitution)
    return Scene([floor(restitution=restitution), ball])


def tower(count=20, radius=10.0):
    """Equal balls on top of each other, in a slot as wide as they are."""
    balls = [Ball((0, -radius * (2 * i + 1)), radius) for i in range(count)]
    return Scene([*slot(2 * radius, 2 * radius * (count + 5)), *balls])


def stack(*masses):
    """Equally large balls of these masses on top of each other, in a slot as wide as they are."""
    balls = [Ball((0, -20 * (2 * i + 1)), 20, mass) for i, mass in enumerate(masses)]
    return Scene([*slot(40, 40 * (len(masses) + 8)), *balls])


def pile(count=200, width=600.0, seed=1):
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


def overlapping(overlap, mass=1.0):
    """Two balls of radius 20 that overlap, the second of another mass, with no gravity."""
    return Scene([Ball((0, 0), 20), Ball((40 - overlap, 0), 20, mass)], gravity=(0, 0))


def squeezed(by, mass=1.0):
    """Two balls, the upper one of another mass, between a floor and a ceiling too low for them."""
    low = [Ball((0, -20 + by / 4), 20), Ball((0, -60 + 3 * by / 4), 20, mass)]
    return Scene([floor(), Block((0, -100 + by), (100, 20)), *low])


def coincident(count=10):
    """Balls with one and the same centre, with no gravity."""
    return Scene([Ball((0, 0)) for _ in range(count)], gravity=(0, 0))


def cradle(gap, count=5, speed=300.0):
    """Equal balls in a row with no gravity, the first on its way to the others."""
    ideal = {"restitution": 1.0, "friction": 0.0}
    row = [Ball((i * (20 + gap), 0), **ideal) for i in range(count - 1)]
    return Scene([Ball((-60, 0), vel=(speed, 0), **ideal), *row], gravity=(0, 0))


LEDGE = Block((0, 0), (150, 10))


def shot(speed, start, restitution=0.0, radius=10.0, thick=20.0):
    """A bullet flying down at a ledge from start px above it, with no gravity."""
    ledge = Block((0, thick / 2), (150, thick / 2), restitution)
    bullet = Ball((0, -radius - start), radius, 1.0, (0, speed), 0.0, restitution, bullet=True)
    return Scene([ledge, bullet], gravity=(0, 0))


def near_miss(speed, start, miss=0.5):
    """A bullet that flies past the right upper corner of the ledge at 45°, miss px away from it."""
    way = math.sqrt(0.5)
    off = (10 + miss) * way - start * way, -(10 + miss) * way - start * way
    pos = (150 + off[0], -10 + off[1])
    bullet = Ball(pos, vel=(speed * way, speed * way), bullet=True)
    return Scene([LEDGE, bullet], gravity=(0, 0))


def inside_ledge(pos):
    """A ball with its centre somewhere in the ledge, with no gravity."""
    return Scene([LEDGE, Ball(pos)], gravity=(0, 0))


def seams(speed):
    """A ball rolling over a floor made of many boxes."""
    boxes = [Block((-200 + 100 * i, 50), (50, 50)) for i in range(40)]
    return Scene([*boxes, Ball((-200, -10), vel=(speed, 0), omega=speed / 10)])


def closed_box(seed):
    """A box filled by 55 % with balls of up to 1000:1 in mass, some on rods, all of them flying."""
    rng = random.Random(seed)
    half, thick = 150.0, 50.0
    out, long = half + thick, half + 2 * thick
    walls = [Block((0, y), (long, thick)) for y in (-out, out)]
    walls += [Block((x, 0), (thick, long)) for x in (-out, out)]
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
    rods = [(len(walls) + 2 * i, len(walls) + 2 * i + 1) for i in range(4)]
    return Scene([*walls, *balls], rods)


# ---------------------------------------------------------------- rods and springs


def pendulum(length=140.0, degrees=90.0):
    """A bob on a rod, let go at an angle from the vertical."""
    angle = math.radians(degrees)
    bob = Ball((length * math.sin(angle), length * math.cos(angle)), 24, mass=6)
    return Scene([Ball((0, 0), 6, mass=0), bob], rods=[(0, 1)])


def chain(links, step, bob=1.0):
    """Balls on rods from a peg, each a step further; the last one has mass bob."""
    balls = [Ball((step[0] * i, step[1] * i), 4) for i in range(1, links + 1)]
    balls[-1].mass = bob
    return Scene([Ball((0, 0), 4, mass=0), *balls], rods=[(i, i + 1) for i in range(links)])


def dumbbell(length, speed):
    """Two balls of radius 5 on a rod that turns at that speed, with no gravity."""
    balls = [Ball((0, 0), 5, vel=(0, -speed)), Ball((length, 0), 5, vel=(0, speed))]
    return Scene(balls, rods=[(0, 1)], gravity=(0, 0))


def oscillator(stiffness):
    """A ball of 1 kg at rest on a spring of 100 px, with no gravity."""
    return Scene(
        [Ball((0, 0), mass=0), Ball((100, 0))], springs=[(0, 1, stiffness)], gravity=(0, 0)
    )


# ---------------------------------------------------------------- effects

EFFECTS = ("Damping", "Springs", "Rods", "Contacts", "Sleep", "Friction", "Bounce", "Bullets")
NEED_CONTACTS = ("Friction", "Bounce", "Bullets")


def all_but(effect):
    """The names of all effects but one, and but those that need it."""
    left_out = (effect, *NEED_CONTACTS) if effect == "Contacts" else (effect,)
    return [name for name in EFFECTS if name not in left_out]


def playground(names):
    """A little of all that the effects of these names are for."""
    balls = [Ball((30 * i, -10 - 5 * i), restitution=0.5) for i in range(6)]
    balls[0].bullet = "Bullets" in names
    return Scene(
        [floor(restitution=0.5), *balls],
        rods=[(2, 3)] if "Rods" in names else [],
        springs=[(4, 5, 50.0)] if "Springs" in names else [],
    )


def build_playground(names):
    """That scene in a world with these effects."""
    return build(playground(names), [getattr(stable_engine, name)() for name in names])


def flying(count, bullets=0):
    """Balls in free fall, far from each other; the first ones are bullets."""
    return Scene([Ball((100 * i, 0), bullet=i < bullets) for i in range(count)])


def lying(count, still):
    """Balls on a floor, each by itself; still more fly far above them."""
    balls = [Ball((100 * i, -10)) for i in range(count)]
    return Scene([floor(), *balls, *(Ball((100 * i, -9000)) for i in range(still))])
