"""Make worlds for tests of the stable engine, beside the experiments' scenes."""

import math
from collections import Counter
from dataclasses import replace

import stable_engine
from experiments.engines import Stable
from experiments.scenes import EFFECTS, NEED_CONTACTS, Ball, Scene, Spring, floor
from stable_engine import Body, Circle

IDEAL = {"restitution": 1.0, "friction": 0.0}


def build(scene, *effects, substeps=4):
    """Build the scene in a world, with these effects or, by default, its own.

    world.bodies has the scene's order.
    """
    return Stable(replace(scene, effects=effects or scene.effects), substeps).world


def all_but(effect):
    """Return the names of all effects except one and those that need it."""
    left_out = (effect, *NEED_CONTACTS) if effect == "Contacts" else (effect,)
    return tuple(name for name in EFFECTS if name not in left_out)


def make(names):
    return [getattr(stable_engine, name)() for name in names]


def balls(world):
    """Return the bodies that can move."""
    return [body for body in world.bodies if not body.is_static]


def bearing_balls(world):
    """Return the balls that touch two bodies or more: one that touches the floor alone rolls on."""
    contacts = world.effects["Contacts"]
    touched = Counter(body for c in contacts.touching if c.impulse > 0 for body in (c.a, c.b))
    return [ball for ball in balls(world) if touched[ball] > 1]


def state(world):
    """Return every number of every body, as raw bits."""
    return [
        number.hex()
        for body in world.bodies
        for number in (body.x, body.y, body.vx, body.vy, body.angle, body.w)
    ]


def add_ideal_ball(world, pos, vel=(0, 0), r=10.0, mass=1.0, bullet=False):
    """Add a smooth elastic ball."""
    ball = world.add(Body(Circle(r), pos, mass, bullet=bullet, **IDEAL))
    ball.vel = vel
    return ball


def playground(names):
    """Make a small scene that uses all these effects."""
    row = [Ball((30 * i, -10 - 5 * i), restitution=0.5) for i in range(6)]
    row[0].bullet, row[0].vel = "Bullets" in names, (2000.0, 0.0)
    springs = [Spring(4, 5, 50.0, length=30.0)]
    return Scene(
        [floor(restitution=0.5), *row], tuple(names), [(2, 3)], springs, damping=(0.05, 0.3)
    )


def build_playground(names):
    """Build that scene in a world with these effects."""
    return build(playground(names))


def flying(count, bullets=0):
    """Make balls in free fall, far from each other; the first ones are bullets."""
    return Scene([Ball((100 * i, 0), bullet=i < bullets) for i in range(count)])


def lying(count, still):
    """Make separate balls on a floor, and more that fly far above them."""
    row = [Ball((100 * i, -10)) for i in range(count)]
    return Scene([floor(), *row, *(Ball((100 * i, -9000)) for i in range(still))])


def whole_energy(world):
    """Return the energy (kg px²/s²) of all motion, of all heights and in all springs."""
    gx, gy = world.g
    energy = sum(
        ball.m * (ball.vel.length_squared() / 2 - gx * ball.x - gy * ball.y)
        + ball.omega**2 / ball.inv_inertia / 2
        for ball in world.bodies
        if ball.inv_mass
    )
    springs = world.effects.get("Springs")
    for spring in springs.joints if springs else []:
        stretch = math.dist(spring.a.pos, spring.b.pos) - spring.length
        energy += spring.stiffness * stretch**2 / 2
    return energy
