"""The window. Time as the difference of two dates."""

import random
from datetime import datetime

import pygame
from lab_runtime import frame_budget
from pygame import Vector2

from .constants import HEIGHT, MAX_BALLS, MAX_STEPS, STEP, WIDTH
from .scenes import ball, make_world
from .shapes import Circle


def advance(world, accumulator, frame_seconds):
    # TODO 6: run whole steps from the accumulator
    accumulator += min(frame_seconds, MAX_STEPS * STEP)
    steps = 0
    while accumulator >= STEP:
        world.step(STEP)
        accumulator -= STEP
        steps += 1
    # END TODO 6
    return accumulator, steps


def draw(screen, font, world):
    screen.fill((20, 20, 20))
    for body in world.bodies:
        if isinstance(body.shape, Circle):
            pygame.draw.circle(screen, body.color, body.pos, body.shape.radius)
            rim = Vector2(body.shape.radius, 0).rotate_rad(body.angle)
            pygame.draw.line(screen, (20, 20, 20), body.pos, body.pos + rim, 2)
        else:
            pygame.draw.rect(screen, body.color, (body.pos - body.shape.half, body.shape.half * 2))
    for rod in world.joints:
        pygame.draw.line(screen, (255, 255, 255), rod.a.pos, rod.b.pos, 2)
    moving = sum(not body.is_static for body in world.bodies)
    text = f"moving: {moving} contacts: {len(world.contacts)}"
    screen.blit(font.render(text, True, (255, 255, 255)), (10, 10))


def handle(event, world, rng):
    """Returns whether to go on, and the world and rng to go on with."""
    if event.type == pygame.QUIT:
        return False, world, rng
    if event.type == pygame.KEYDOWN and event.key == pygame.K_r:
        rng = random.Random(12)
        return True, make_world(rng), rng
    if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
        if sum(not body.is_static for body in world.bodies) < MAX_BALLS:
            world.add(ball(rng, event.pos))
    return True, world, rng


def report(steps, world):
    rod = world.joints[0]
    print("Fixed steps:", steps)
    print(f"Pendulum length error: {abs((rod.b.pos - rod.a.pos).length() - rod.length):.2f} px")


def main():
    pygame.init()
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    font = pygame.font.Font(None, 24)
    clock = pygame.time.Clock()
    rng = random.Random(12)
    world = make_world(rng)
    accumulator, total, running = 0.0, 0, True
    before = datetime.now()
    while running and frame_budget():
        now = datetime.now()
        accumulator, steps = advance(world, accumulator, (now - before).total_seconds())
        total += steps
        before = now
        for event in pygame.event.get():
            going_on, world, rng = handle(event, world, rng)
            running = running and going_on
        draw(screen, font, world)
        pygame.display.flip()
        clock.tick(60)
    pygame.quit()
    report(total, world)
