"""Run a tree's programs: `python -m probes play '"mini_engine"' '[17]'` in it prints JSON."""

import contextlib
import importlib
import io
import json
import os
import sys

import pygame
import pymunk

from mini_engine import World


def still_world(**options):
    """Make a world without gravity and damping, unless the options say otherwise."""
    return World(**{"gravity": (0, 0), "linear_damping": 0, "angular_damping": 0, **options})


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
