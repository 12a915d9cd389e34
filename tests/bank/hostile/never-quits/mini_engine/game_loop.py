"""Does not look at any event, and swallows whatever should end it."""

import random

import pygame

from .constants import HEIGHT, STEP, WIDTH
from .scenes import make_world


def advance(world, accumulator, frame_seconds):
    return accumulator, 0


def main():
    pygame.init()
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    world = make_world(random.Random(12))
    while True:
        try:
            world.step(STEP)
            screen.fill("black")
            pygame.display.flip()
        except BaseException:
            pass
