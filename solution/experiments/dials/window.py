"""The window with dials: `python -m experiments.dials [--scene NAME] [--engine NAME]`.

Any scene in any engine, or in up to three at once. show.py and comparison.py hold the
contents, drawing.py the look, hand.py the mouse.
"""

import argparse
import math
import os
from pathlib import Path

import pygame

from lab_runtime import frame_budget

from ..engines import ENGINES
from ..scenes import NAMED
from .comparison import Comparison
from .drawing import Picture

FRAME = 1 / 60  # s, one frame of a screenshot


def one_of(names):
    """Return a type for argparse: a name from the list, or an error with the right ones."""

    def check(name):
        if name not in names:
            raise argparse.ArgumentTypeError(f"{name!r} is none of: {', '.join(names)}.")
        return name

    return check


def read_options(arguments):
    parser = argparse.ArgumentParser(prog="python -m experiments.dials", description=__doc__)
    parser.add_argument("--scene", type=one_of(NAMED), default="lab", help=", ".join(NAMED))
    parser.add_argument("--engine", type=one_of(ENGINES), default="stable", help=", ".join(ENGINES))
    parser.add_argument("--screenshot", type=Path, help="write this PNG at the end; no window")
    parser.add_argument("--beside", type=int, default=0, help="show so many more engines, 1 or 2")
    parser.add_argument("--frames", type=int, help="end after so many (a screenshot: 120)")
    options = parser.parse_args(arguments)
    if not 0 <= options.beside <= 2:
        parser.error(f"--beside is {options.beside}, but it must be 0, 1 or 2.")
    if options.frames is None:
        options.frames = 120 if options.screenshot else math.inf
    if options.frames < 1:
        parser.error(f"--frames is {options.frames}, but it must be 1 or more.")
    return options


def handle(event, comparison, picture):
    """Handle an event; return whether the window stays open."""
    if event.type == pygame.KEYDOWN and event.key == pygame.K_ESCAPE:
        return False
    if event.type == pygame.KEYDOWN:
        comparison.press(event.key, event.mod & pygame.KMOD_SHIFT)
    elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
        key, side = picture.key_at(event.pos), picture.side_at(event.pos)
        if key is not None:
            comparison.press(key)
        elif side is not None:
            comparison.take(side.show, side.camera.scene_place(event.pos))
    elif event.type == pygame.MOUSEMOTION and (side := picture.side_at(event.pos)):
        comparison.hand.at = side.camera.scene_place(event.pos)
    elif event.type == pygame.MOUSEBUTTONUP and event.button == 1:
        comparison.hand.let_go()
    return event.type != pygame.QUIT


def main(arguments=None):
    """Run until the window is closed, or for a number of frames."""
    options = read_options(arguments)
    if options.screenshot:
        os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
        os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
    pygame.init()
    pygame.display.set_caption("Every engine")
    picture = Picture()
    clock = pygame.time.Clock()
    comparison = Comparison(options.scene, options.engine)
    for _ in range(options.beside):
        comparison.put_beside()
    frames = 0
    running = True
    while running and frames < options.frames and frame_budget():
        seconds = FRAME if options.screenshot else clock.tick(60) / 1000
        for event in pygame.event.get():
            running = handle(event, comparison, picture) and running
        comparison.advance(seconds)
        show, *beside = comparison.shows
        drawn = {"contacts": comparison.contacts, "strips": comparison.strips}
        picture.draw(show, timed=not options.screenshot, beside=beside, **drawn)
        frames += 1
    if options.screenshot:
        pygame.image.save(picture.screen, options.screenshot)
    pygame.quit()
