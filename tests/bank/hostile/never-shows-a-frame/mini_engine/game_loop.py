"""Steps for ever without showing anything."""

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
        world.step(STEP)
