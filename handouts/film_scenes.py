"""Run the scenes that the films of the lab sheet show, one per TODO, with the current tree.

    python film_scenes.py TODO

It prints the scene as JSON, as the player of replays reads it. `make_films.py` starts it in copies
of the solution, one of them right and two with a known mistake.
"""

import json
import math
import sys

import integrators
import mini_engine
import pymunk_scene
from mini_engine import Body, Box, Circle, DistanceJoint, World

STEP = 1 / 120  # s
EVERY = 4  # steps from one shot to the next: 30 shots a second
FLOOR = (0, 120)  # px, the centre of a floor whose surface is at y = 100


class Film:
    """The shots of one run: places to a tenth of a px, angles to a hundredth of a rad."""

    def __init__(self, view, curve=False):
        self.view, self.curve = view, curve  # left, top, right, bottom in px
        self.looks, self.frames, self.last = {}, [], {}

    def look(self, number, points, radius=0.0, mass=1.0):
        """Describe a body's looks by its centre and a radius (a disc), or by its corners."""
        self.looks[number] = {"shapes": [[points, radius]], "mass": mass, "moment": None, "ref": 0}

    def shoot(self, time, rows, rods=()):
        """Record a shot; `rows` has x, y, vx, vy, angle and omega of each body, by its number."""
        rows = {n: [fixed(v, 2 if at > 3 else 1) for at, v in enumerate(row)] for n, row in rows}
        changed = [[n, *row] for n, row in rows.items() if self.last.get(n) != row]
        ends = [[fixed(v, 1) for v in each] for each in rods]
        self.frames.append([round(time, 3), 1, changed, [] if not self.frames else None, ends, []])
        self.last = rows

    def data(self):
        scene = {"curve": self.curve, "looks": self.looks, "yours": self.frames, "expected": []}
        return {**scene, "expected_looks": {}, "names": {}, "view": self.view}


def fixed(value, digits):
    """Round a number to so many decimals, and cap large ones."""
    return round(max(-9999.0, min(9999.0, value)), digits) + 0.0


# ---------------------------------------------------------------- the lesson's engine


def engine_film(world, view, seconds, advance=None):
    """Shoot a world of the lesson's engine. `advance(frame)` runs the steps of one shot."""
    film = Film(view)
    for number, body in enumerate(world.bodies, 1):
        if isinstance(body.shape, Circle):
            points, radius = [[0, 0]], body.shape.radius
        else:
            x, y = body.shape.half
            points, radius = [[-x, -y], [x, -y], [x, y], [-x, y]], 0
        film.look(number, points, radius, None if body.is_static else 1 / body.inv_mass)
    for frame in range(round(seconds / (EVERY * STEP)) + 1):
        if frame:
            (advance or plain_steps(world))(frame)
        rods = [(*joint.a.pos, *joint.b.pos) for joint in world.joints]
        film.shoot(
            frame * EVERY * STEP, [(n, state(b)) for n, b in enumerate(world.bodies, 1)], rods
        )
    return film


def plain_steps(world):
    def advance(_):
        for _ in range(EVERY):
            world.step(STEP)

    return advance


def state(body):
    return *body.pos, *body.vel, body.angle, body.omega


def still_world(gravity=(0, 980)):
    """Make a world without damping, so that only a mistake in TODO 5 damps."""
    return World(gravity, 0.0, 0.0)


def corner():
    world = still_world()
    world.add(Body(Box((70, 25)), (0, 40), restitution=0.6))
    world.add(Body(Circle(18), (80, -90), mass=1, restitution=0.6))
    return engine_film(world, [-120, -120, 240, 130], 1.2)


def spinning_drop():
    world = still_world()
    world.add(Body(Box((400, 20)), FLOOR, friction=0.6, restitution=0.4))
    ball = world.add(Body(Circle(22), (-120, 0), mass=4, friction=0.6, restitution=0.4))
    ball.omega = 25
    return engine_film(world, [-180, -30, 240, 130], 1.6)


def thrown_rod():
    world = still_world()
    peg = world.add(Body(Circle(5), (0, 0)))
    bob = world.add(Body(Circle(16), (-85, -85), mass=6))
    world.joints.append(DistanceJoint(peg, bob))
    return engine_film(world, [-160, -130, 160, 190], 2.0)


def slippery():
    world = still_world()
    world.add(Body(Box((600, 20)), FLOOR, friction=0.05))
    ball = world.add(Body(Circle(22), (-280, 78), mass=4, friction=0.05))
    ball.vel.x = 300
    return engine_film(world, [-310, 30, 310, 130], 1.6)


def coasting():
    world = World((0, 0), 0.5, 0.5)
    ball = world.add(Body(Circle(22), (-280, 0), mass=4))
    ball.vel.x, ball.omega = 300, 8
    return engine_film(world, [-310, -50, 310, 50], 1.8)


FRAME = 1 / 50  # s: one frame owes 2.4 steps


def in_frames(advance, world):
    """Return a function that runs the steps of a shot in frames, 50 of them a second."""
    kept = {"accumulator": 0.0, "frames": 0}

    def run(shot):
        while kept["frames"] * FRAME < shot * EVERY * STEP - 1e-9:
            kept["accumulator"], _ = advance(world, kept["accumulator"], FRAME)
            kept["frames"] += 1

    return run


def falling():
    world = still_world()
    world.add(Body(Box((200, 20)), (0, 400), restitution=0.6))
    world.add(Body(Circle(22), (0, 0), mass=4, restitution=0.6))
    view = [-280, -40, 280, 430]
    return engine_film(world, view, 1.5, in_frames(mini_engine.advance, world))


# ---------------------------------------------------------------- pymunk


def space_film(space, bodies, view, seconds, fixed_shapes=(), run=None, rod_from=None):
    film = Film(view)
    for number, body in enumerate(bodies, 1):
        (shape, *_) = body.shapes
        film.look(number, [[0, 0]], shape.radius, body.mass)
    for number, (_, points, radius) in enumerate(fixed_shapes, len(bodies) + 1):
        film.look(number, points, radius, None)
    still = [(n, (*c, 0, 0, 0, 0)) for n, (c, _, _) in enumerate(fixed_shapes, len(bodies) + 1)]
    for frame in range(round(seconds / (EVERY * STEP)) + 1):
        if frame and run:
            run(frame)
        elif frame:
            for _ in range(EVERY):
                space.step(STEP)
        rows = [(n, moving(body)) for n, body in enumerate(bodies, 1)]
        rods = [(*rod_from, *bodies[0].position)] if rod_from and space.constraints else []
        film.shoot(frame * EVERY * STEP, [*rows, *still], rods)
    return film


def moving(body):
    return *body.position, *body.velocity, body.angle, body.angular_velocity


def ball_of(space, pos, radius=22):
    """Let the program make a ball of this size."""

    class Chosen:
        def randint(self, low, high):
            return min(max(radius, low), high)

    return pymunk_scene.add_ball(space, Chosen(), pos)


def dropped():
    space = pymunk_scene.empty_space()
    ball = ball_of(space, (0, 0))
    return space_film(space, [ball], [-200, -180, 200, 180], 0.8)


def down_a_slope():
    space = pymunk_scene.empty_space()
    angle = math.radians(20)
    space.gravity = (980 * math.sin(angle), 980 * math.cos(angle))
    pymunk_scene.add_static_box(space, (0, 120), (1200, 40))
    ball = ball_of(space, (-280, 78))
    box = ((0, 120), [[-600, -20], [600, -20], [600, 20], [-600, 20]], 0)
    return space_film(space, [ball], [-310, 20, 310, 150], 1.5, [box])


def hung():
    space = pymunk_scene.empty_space()
    space.gravity = (0, 980)
    bob = pymunk_scene.add_pendulum(space)
    bob.velocity = (0, -450)
    peg = ((700, 90), [[0, 0]], 6)
    return space_film(space, [bob], [500, -110, 920, 290], 2.0, [peg], rod_from=(700, 90))


def falling_in_pymunk():
    space = pymunk_scene.empty_space()
    space.gravity, space.damping = (0, 980), 1.0
    pymunk_scene.add_static_box(space, (0, 400), (400, 40))
    ball = ball_of(space, (0, 0))
    box = ((0, 400), [[-200, -20], [200, -20], [200, 20], [-200, 20]], 0)
    run = in_frames(pymunk_scene.advance, space)
    return space_film(space, [ball], [-280, -40, 280, 430], 1.5, [box], run)


# ---------------------------------------------------------------- integrators


def spring(method, steps=9, swings=3.0):
    """Plot x over time on a spring that swings once a second, released at 100 px."""

    def scene():
        film = Film([0, -260, swings, 260], curve=True)
        film.look(1, [])
        x, v, dt = 100.0, 0.0, 1 / steps
        step = getattr(integrators, method)
        for n in range(round(swings * steps) + 1):
            film.shoot(n * dt, [(1, (x, 0, v, 0, 0, 0))])
            x, v = step(x, v, dt, lambda place: -((2 * math.pi) ** 2) * place)
        return film

    return scene


SCENES = {
    "1": corner,
    "2": spinning_drop,
    "3": thrown_rod,
    "4": slippery,
    "5": coasting,
    "6": falling,
    "7a": dropped,
    "7b": down_a_slope,
    "7c": hung,
    "7d": falling_in_pymunk,
    "8a": spring("semi_implicit_euler"),
    "8b": spring("velocity_verlet", steps=6),
    "8c": spring("rk4", steps=5),
}

if __name__ == "__main__":
    print(json.dumps(SCENES[sys.argv[1]]().data(), separators=(",", ":")))
