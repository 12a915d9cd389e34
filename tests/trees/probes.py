"""Run experiments on a tree: `python -m probes slide 16`, started in its folder, prints JSON."""

import contextlib
import importlib
import io
import json
import os
import random
import sys

import pygame
import pymunk

import mini_engine
import pymunk_scene
from mini_engine import STEP, Body, Box, Circle, World


def still_world(**options):
    """Make a world without gravity and damping, unless the options say otherwise."""
    return World(**{"gravity": (0, 0), "linear_damping": 0, "angular_damping": 0, **options})


def slide(radius, friction=0.6, seconds=2.0):
    """Slide a ball at 300 px/s; return (speed, omega) after every step."""
    world = still_world(gravity=(0, 980))
    world.add(Body(Box((5000, 20)), (0, 20), friction=friction))
    ball = Body(Circle(radius), (0, -radius), mass=radius**2 / 100, friction=friction)
    world.add(ball).vel.x = 300
    trail = []
    for _ in range(round(seconds / STEP)):
        world.step(STEP)
        trail.append((ball.vel.x, ball.omega))
    return trail


def slip(trail, radius):
    """Return the largest slip of a slide between 1 s and 2 s, as a share of the rolling speed."""
    return max(abs(speed - omega * radius) / abs(omega * radius) for speed, omega in trail[120:])


def coast(rate, dt, seconds=1.0):
    """Return the shares of speed and spin that a free body keeps."""
    world = still_world(linear_damping=rate, angular_damping=rate)
    body = world.add(Body(Circle(10), (0, 0), mass=1))
    body.vel.x, body.omega = 1, 1
    for _ in range(round(seconds / dt)):
        world.step(dt)
    return body.vel.x, body.omega


def lab_scene(seconds):
    """Run the mini engine's scene; return moving bodies as (x, y), and boxes ever touched."""
    world = mini_engine.make_world(random.Random(12))
    touched = set()
    for _ in range(round(seconds / STEP)):
        world.step(STEP)
        touched |= {world.bodies.index(c.b) for c in world.contacts if isinstance(c.b.shape, Box)}
    return [tuple(body.pos) for body in world.moving_bodies()], sorted(touched)


def pymunk_lab_scene(seconds):
    """Run the pymunk scene; return moving bodies as (x, y, angle)."""
    space, _ = pymunk_scene.make_space(random.Random(12))
    for _ in range(round(seconds / STEP)):
        space.step(STEP)
    return [(*body.position, body.angle) for body in space.bodies]


# ---------------------------------------------------------------- playing


def play(module, frames, events=()):
    """Run a program's main() with frames of these ms, and events as [frame, type, fields].

    Returns the printed lines, and for each frame the lines of text and (x, y) of moving bodies.
    """
    program = importlib.import_module(module)
    owner = getattr(program, "Window", program)  # of draw
    seen, texts, real_draw = [], [], owner.draw

    class Clock:
        def __init__(self):
            self.frame = -1

        def tick(self, _rate):
            self.frame += 1
            for frame, kind, fields in events:
                if frame == self.frame:
                    pygame.event.post(pygame.event.Event(getattr(pygame, kind), fields))
            return frames[self.frame]

    class Font(pygame.font.Font):
        def render(self, text, *style):
            texts.append(text)
            return super().render(text, *style)

    def draw(*shown):
        texts.clear()
        real_draw(*shown)
        world = getattr(shown[-1], "world", shown[-1])  # of a window, or of draw(…, world)
        seen.append({"text": texts[:], "moving": positions(world)})

    owner.draw, pygame.time.Clock, pygame.font.Font = draw, Clock, Font
    os.environ["LAB_FRAMES"] = str(len(frames))
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        program.main()
    return {"printed": printed.getvalue().splitlines(), "frames": seen}


def positions(world):
    if isinstance(world, pymunk.Space):
        return [tuple(body.position) for body in world.bodies]
    return [tuple(body.pos) for body in world.moving_bodies()]


if __name__ == "__main__":
    print(json.dumps(globals()[sys.argv[1]](*map(json.loads, sys.argv[2:]))))
