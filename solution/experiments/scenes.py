"""Every scene of the experiments, as plain data. Lengths in px, times in s, masses in kg, y down.

A scene names the effects it needs. The builders in engines/ make it for each engine.
"""

import math
import random
from dataclasses import dataclass, field, replace

from mini_engine import STEP, Box, make_world

G = 980.0  # px/s²
DT = STEP  # s
SEED = 12

TOUCH = ("Contacts", "Friction")
BOUNCE = ("Contacts", "Friction", "Bounce")
BULLETS = ("Contacts", "Friction", "Bounce", "Bullets")
EFFECTS = ("Contacts", "Friction", "Bounce", "Rods", "Springs", "Damping", "Bullets", "Sleep")
NEED_CONTACTS = ("Friction", "Bounce", "Bullets")


@dataclass
class Ball:
    """A disc. Mass 0 makes it static."""

    pos: tuple
    radius: float = 10.0
    mass: float = 1.0
    vel: tuple = (0.0, 0.0)
    omega: float = 0.0
    restitution: float = 0.0
    friction: float = 0.6
    bullet: bool = False


@dataclass
class Block:
    """A static box."""

    pos: tuple
    half: tuple
    restitution: float = 0.0
    friction: float = 0.6


@dataclass
class Spring:
    """A spring between the bodies at indices a and b of the scene's list."""

    a: int
    b: int
    stiffness: float  # kg/s²
    damping: float = 0.0  # kg/s
    length: float = 0.0  # px


@dataclass
class Scene:
    """Bodies and joints; a rod is the indices of two bodies in the list."""

    bodies: list
    effects: tuple = TOUCH
    rods: list = field(default_factory=list)  # (a, b)
    springs: list = field(default_factory=list)
    gravity: tuple = (0.0, G)
    damping: tuple = (0.0, 0.0)  # rates per second: of velocity, of spin
    unit: float = 1.0  # a pixel in the scene's unit of length: 0.01 in metres

    def moving(self):
        """Return the indices of the bodies that can move."""
        return [i for i, body in enumerate(self.bodies) if isinstance(body, Ball) and body.mass > 0]


def lab():
    """Return the scene of the lesson's window: pegs, a ledge, a pendulum and eight balls."""
    world = make_world(random.Random(SEED))
    place = {body: i for i, body in enumerate(world.bodies)}
    return Scene(
        [as_data(body) for body in world.bodies],
        effects=("Contacts", "Friction", "Bounce", "Rods", "Damping"),
        rods=[(place[joint.a], place[joint.b]) for joint in world.joints],
        damping=(world.linear_damping, world.angular_damping),
    )


def as_data(body):
    """Return a body of the lesson's engine as plain data."""
    pos, surface = tuple(body.pos), (body.restitution, body.friction)
    if isinstance(body.shape, Box):
        return Block(pos, tuple(body.shape.half), *surface)
    mass = 0.0 if body.is_static else 1 / body.inv_mass
    return Ball(pos, body.shape.radius, mass, tuple(body.vel), body.omega, *surface)


# ---------------------------------------------------------------- stacks and piles


def floor(**surface):
    """Return a floor with its surface at y = 0."""
    return Block((0, 500), (5000, 500), **surface)


def slot(width, height, thick=20.0):
    """Return a floor with its surface at y = 0, and two walls around x = 0."""
    side = width / 2 + thick
    return [
        Block((0, thick), (width / 2 + 2 * thick, thick)),
        Block((-side, -height / 2), (thick, height / 2)),
        Block((side, -height / 2), (thick, height / 2)),
    ]


def tower(count=20, radius=10.0):
    """Make equal balls on top of each other, in a slot of their width."""
    balls = [Ball((0, -radius * (2 * i + 1)), radius) for i in range(count)]
    return Scene([*slot(2 * radius, 2 * radius * (count + 5)), *balls])


def stack(*masses):
    """Make equally large balls of these masses, from the lowest up, in a slot of their width."""
    balls = [Ball((0, -20 * (2 * i + 1)), 20, mass) for i, mass in enumerate(masses)]
    return Scene([*slot(40, 40 * (len(masses) + 8)), *balls])


def pile(count=200, width=600.0, seed=1):
    """Make balls of several sizes rained into a bin."""
    rng = random.Random(seed)
    columns = int(width // 26)
    balls = []
    for i in range(count):
        row, column = divmod(i, columns)
        radius = rng.uniform(8, 12)
        pos = (26 * (column + 0.5) - width / 2 + rng.uniform(-0.5, 0.5), -26 * row - 14)
        balls.append(Ball(pos, radius, mass=radius**2 / 100))
    return Scene([*slot(width, 26 * (count / columns + 5), 50), *balls])


# ---------------------------------------------------------------- bad starts


def overlapping(overlap=30.0, mass=1.0):
    """Make two overlapping balls of radius 20, the second of another mass; no gravity."""
    balls = [Ball((0, 0), 20), Ball((40 - overlap, 0), 20, mass)]
    return Scene(balls, gravity=(0, 0))


def squeezed(by=8.0, mass=1.0):
    """Make two balls, the upper with `mass`, between a floor and a ceiling too close for them."""
    low = [Ball((0, -20 + by / 4), 20), Ball((0, -60 + 3 * by / 4), 20, mass)]
    return Scene([floor(), Block((0, -100 + by), (100, 20)), *low])


def coincident(count=10):
    """Make balls with the same centre, without gravity."""
    return Scene([Ball((0, 0)) for _ in range(count)], gravity=(0, 0))


def inside_ledge(pos=(0, 0)):
    """Make a ball with its centre in the ledge, without gravity."""
    return Scene([LEDGE, Ball(pos)], gravity=(0, 0))


def closed_box(seed=1, half=150.0, thick=50.0, radii=(6, 22), pairs=4):
    """Make a box filled by 55 % with flying balls of up to 1000:1 in mass, `pairs` pairs on rods.

    Radii lie between these two. Every ball and wall has a restitution of its own.
    """
    rng = random.Random(seed)
    out, long = half + thick, half + 2 * thick
    walls = [Block((0, y), (long, thick)) for y in (-out, out)]
    walls += [Block((x, 0), (thick, long)) for x in (-out, out)]
    balls = []
    filled = 0.0
    while filled < 0.55 * (2 * half) ** 2:
        radius = rng.uniform(*radii)
        reach = half - radius
        pos = (rng.uniform(-reach, reach), rng.uniform(-reach, reach))
        vel = (rng.uniform(-400.0, 400.0), rng.uniform(-400.0, 400.0))
        mass, bounce = 10 ** rng.uniform(-1.5, 1.5), rng.uniform(0, 0.9)
        balls.append(Ball(pos, radius, mass, vel, 0.0, bounce, rng.uniform(0, 1)))
        filled += math.pi * radius**2
    for wall in walls:
        wall.restitution = rng.uniform(0, 1)
    rods = [(len(walls) + 2 * i, len(walls) + 2 * i + 1) for i in range(pairs)]
    return Scene([*walls, *balls], (*BOUNCE, "Rods"), rods)


def rammer(mass, speed, restitution=0.3):
    """Make a ball of 1 kg that flies at a wall, `mass` kg on a rod behind it, without gravity."""
    wall = Block((10.0, 0), (10.0, 300), restitution)
    light = Ball((-50.0, 0), 10, 1.0, (speed, 0), restitution=restitution)
    heavy = replace(light, pos=(-80.0, 0.0), mass=mass)  # the rod is 30 px long
    return Scene([wall, light, heavy], (*BOUNCE, "Rods"), [(1, 2)], gravity=(0, 0))


# ---------------------------------------------------------------- bouncing and fast balls


def drop(height=290.0, restitution=1.0):
    """Make one ball high above a floor, both with the same restitution."""
    ball = Ball((0, -10 - height), restitution=restitution)
    return Scene([floor(restitution=restitution), ball], BOUNCE)


def cradle(count=5, thrown=1, gap=0.0):
    """Make Newton's cradle without strings: some balls fly at the others."""
    ideal, width = {"restitution": 1.0, "friction": 0.0}, 20 + gap
    flying = [Ball((-60 - i * width, 0), vel=(300.0, 0), **ideal) for i in range(thrown)]
    row = [Ball((i * width, 0), **ideal) for i in range(thrown - 1, count - 1)]
    return Scene([*flying[::-1], *row], ("Contacts", "Bounce"), gravity=(0, 0))


LEDGE = Block((0, 0), (150, 10))


def shot(speed=2448.0, start=100.0, restitution=0.0, radius=10.0, thick=20.0, bullet=True):
    """Make a bullet, or a ball, that flies at a ledge `start` px below; no gravity."""
    ledge = Block((0, thick / 2), (150, thick / 2), restitution)
    ball = Ball((0, -radius - start), radius, 1.0, (0, speed), 0.0, restitution, bullet=bullet)
    return Scene([ledge, ball], BULLETS, gravity=(0, 0))


def near_miss(speed):
    """Make a bullet that misses the right upper corner of a ledge, at 45°, by half a pixel."""
    way = math.sqrt(0.5)
    pos = (150 + (10.5 * way - 100 * way), -10 + (-10.5 * way - 100 * way))
    bullet = Ball(pos, vel=(speed * way, speed * way), bullet=True)
    return Scene([LEDGE, bullet], BULLETS, gravity=(0, 0))


# ---------------------------------------------------------------- rolling and sliding


def on_floor(radius=10.0, **ball):
    """Make one ball that touches the floor."""
    return Scene([floor(), Ball((0, -radius), radius, **ball)])


def resting(radius=10.0):
    """Make a ball on a floor many times its size."""
    ground = Block((0, 50 * radius), (500 * radius, 50 * radius))
    return Scene([ground, Ball((0, -radius), radius)])


def incline(degrees=20.0, friction=0.6):
    """Make a ball on a slope, by tilted gravity. It rolls, or slides if the slope is too steep."""
    angle = math.radians(degrees)
    bodies = [floor(friction=friction), Ball((0, -10.0), friction=friction)]
    return Scene(bodies, gravity=(G * math.sin(angle), G * math.cos(angle)))


def seams(speed=300.0):
    """Make a ball rolling over a floor made of many boxes."""
    boxes = [Block((-200 + 100 * i, 50), (50, 50)) for i in range(40)]
    ball = Ball((-200, -10), vel=(speed, 0), omega=speed / 10)
    return Scene([*boxes, ball])


# ---------------------------------------------------------------- rods and springs


def pendulum(length=140.0, degrees=90.0):
    """Make a bob on a rod, let go at an angle from the vertical."""
    angle = math.radians(degrees)
    bob = Ball((length * math.sin(angle), length * math.cos(angle)), 24, mass=6)
    return Scene([Ball((0, 0), 6, mass=0), bob], effects=("Rods",), rods=[(0, 1)])


def pendulum_period(length=140.0, degrees=90.0):
    """Return the exact period in s: 2 pi sqrt(l/g) / agm(1, cos(angle/2))."""
    a, b = 1.0, math.cos(math.radians(degrees) / 2)
    for _ in range(8):  # the arithmetic-geometric mean doubles its digits each time
        a, b = (a + b) / 2, math.sqrt(a * b)
    return 2 * math.pi * math.sqrt(length / G) / a


def find_pendulum_angle(seconds, length):
    """Return the exact angle (rad) of a pendulum some seconds after its release at 90 degrees.

    sin(angle / 2) is k cd(seconds sqrt(G / length), k), by Landen's steps to smaller moduli.
    """
    k = math.sin(math.pi / 4)
    means, gaps = [1.0], [k]
    while gaps[-1] > 1e-16:
        a, b = means[-1], math.sqrt(means[-1] ** 2 - gaps[-1] ** 2)
        means.append((a + b) / 2)
        gaps.append((a - b) / 2)
    # A quarter of the period later, cd is sn, whose amplitude the steps find.
    quarter = math.pi / 2 / means[-1]
    turn = 2 ** (len(means) - 1) * means[-1] * (seconds * math.sqrt(G / length) + quarter)
    for a, gap in zip(reversed(means[1:]), reversed(gaps[1:]), strict=True):
        turn = (turn + math.asin(gap / a * math.sin(turn))) / 2
    return 2 * math.asin(k * math.sin(turn))


def chain(links=20, step=(0.0, 20.0), bob=1.0):
    """Make balls on rods from a peg, each `step` further; the last has mass `bob`."""
    balls = [Ball((step[0] * i, step[1] * i), 4) for i in range(1, links + 1)]
    balls[-1].mass = bob
    rods = [(i, i + 1) for i in range(links)]
    return Scene([Ball((0, 0), 4, mass=0), *balls], ("Rods",), rods)


def oscillator(stiffness=(2 * math.pi) ** 2, stretch=50.0, damping=0.0):
    """Make a ball of 1 kg on a spring of 100 px, pulled out by `stretch` px, no gravity."""
    balls = [Ball((0, 0), mass=0), Ball((100 + stretch, 0))]
    spring = Spring(0, 1, stiffness, damping, length=100)
    return Scene(balls, ("Springs",), springs=[spring], gravity=(0, 0))


def shuffled(scene, seed=SEED):
    """Return the scene with its bodies in another order, and the old index of each body."""
    order = list(range(len(scene.bodies)))
    random.Random(seed).shuffle(order)
    place = {old: new for new, old in enumerate(order)}
    rods = [(place[a], place[b]) for a, b in scene.rods]
    springs = [replace(s, a=place[s.a], b=place[s.b]) for s in scene.springs]
    bodies = [scene.bodies[i] for i in order]
    return replace(scene, bodies=bodies, rods=rods, springs=springs), order


NAMED = {
    "lab": lab,
    "tower": tower,
    "stack": lambda: stack(1, 100),
    "pile": lambda: pile(60, 300),
    "silo": lambda: pile(60, 60.0),
    "pendulum": pendulum,
    "chain": lambda: chain(20, (20, 0)),
    "cradle": cradle,
    "squeeze": squeezed,
    "overlap": overlapping,
    "coincident": coincident,
    "bullet": shot,
    "spring": oscillator,
    "box": closed_box,
}
