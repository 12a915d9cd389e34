"""Test programs that do anything at any time: they meet no error but those of bad values."""

import math
import random
from contextlib import suppress

import pytest
from worlds_for_tests import make

from stable_engine import Body, Box, Circle, Contacts, Rod, Segment, Spring, World

HALF = 150  # px, of the room
STEPS = (1 / 60, 1 / 60, 1 / 144, 1 / 30, 1e-3, 1e-6, 1e-9, 0.1)  # s
OTHERS = ("Friction", "Bounce", "Rods", "Springs", "Kinematics", "Sleep", "Bullets", "Damping")


class Program:
    """A world in a room, with some effects, and acts that change it at random."""

    def __init__(self, seed):
        self.rng = rng = random.Random(f"any program {seed}")
        self.touching = set()
        effects = make([name for name in OTHERS if rng.random() < 0.7])
        self.world = World((0, 980), effects=[Contacts(self.meet, self.part), *effects])
        for x, y, hx, hy in ((0, 1, 1, 0), (0, -1, 1, 0), (1, 0, 0, 1), (-1, 0, 0, 1)):
            half = HALF * hx + 20, HALF * hy + 20
            self.world.add(Body(Box(half), (x * (HALF + 20), y * (HALF + 20))))
        self.walls = list(self.world.bodies)
        self.acts = [self.add, self.remove, self.tie, self.untie, self.put, self.throw, self.push]
        self.acts += [self.set_body, self.set_joint, self.set_world, self.look]

    def meet(self, a, b, speed):
        assert 0 <= speed < math.inf
        assert (a, b) not in self.touching
        self.touching.add((a, b))

    def part(self, a, b):
        self.touching.discard((a, b))

    def place(self):
        return self.rng.uniform(5 - HALF, HALF - 5), self.rng.uniform(5 - HALF, HALF - 5)

    def vector(self, size):
        return self.rng.gauss(0, size), self.rng.gauss(0, size)

    def choose(self, things):
        if not things:
            raise ValueError("There is none yet.")
        return self.rng.choice(things)

    def any_body(self):
        return self.choose([body for body in self.world.bodies if body not in self.walls])

    def any_joint(self):
        effects = self.world.effects.values()
        return self.choose([joint for one in effects for joint in getattr(one, "joints", [])])

    def add(self):
        rng = self.rng
        shape = rng.choice([Circle(rng.choice([3, 10, 40])), Box((20, 5)), self.line()])
        if rng.random() < 0.7:
            body = self.world.add(Body(Circle(rng.choice([3, 10, 30])), self.place(), 1.0))
            body.vel = self.vector(200)
        else:
            body = self.world.add(Body(shape, self.place(), kinematic=rng.random() < 0.3))
            body.vel = self.vector(100)

    def line(self):
        return Segment(self.place(), self.place(), self.rng.choice([0, 3]))

    def remove(self):
        body = self.any_body()
        self.world.remove(body)
        self.touching = {pair for pair in self.touching if body not in pair}

    def tie(self):
        a, b = self.any_body(), self.any_body()
        stiff = 10 ** self.rng.uniform(0, 7)
        self.world.add(Rod(a, b) if self.rng.random() < 0.5 else Spring(a, b, stiff, 1.0))

    def untie(self):
        self.world.remove(self.any_joint())

    def put(self):
        self.any_body().pos = self.place()

    def throw(self):
        self.any_body().vel = self.vector(500)

    def push(self):
        self.any_body().apply_force(self.vector(1e5), self.place())

    def set_body(self):
        body, rng = self.any_body(), self.rng
        body.friction, body.restitution = rng.choice([0, 1, 5]), rng.random()
        body.bullet = rng.random() < 0.5
        body.mass = 10 ** rng.uniform(-2, 3)

    def set_joint(self):
        self.any_joint().length = self.rng.uniform(1, 120)

    def set_world(self):
        self.world.gravity = self.rng.choice([(0, 980), (0, 0), (-500, 0)])
        self.world.substeps = self.rng.choice([1, 2, 4, 8])

    def look(self):
        self.world.ray_cast(self.place(), self.place())
        self.world.bodies_at(self.place())
        self.world.check()

    def run(self, count):
        for _ in range(12):
            with suppress(ValueError):
                self.add()
        for _ in range(count):
            with suppress(ValueError):  # a value that makes no sense here, or nothing to choose
                self.rng.choice(self.acts)()
            self.world.step(self.rng.choice(STEPS))


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("seed", [*range(20), 644])
def test_a_program_may_do_anything_at_any_time(seed):
    Program(seed).run(80)


@pytest.mark.soak
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_a_thousand_programs_may_do_anything_at_any_time():
    for seed in range(1000):
        Program(seed).run(160)
