"""The window: time, events, drawing. TODO 6 lives in advance."""

import random

import pygame
from pygame import Vector2

from lab_runtime import frame_budget

from .constants import HEIGHT, MAX_BALLS, MAX_STEPS, STEP, WIDTH
from .scenes import ball, make_world
from .shapes import Circle

MAX_FRAME = MAX_STEPS * STEP  # s, the most time one frame may add
SEED = 12
BACKGROUND = (22, 25, 33)
INK = (225, 228, 235)
HELP = "click: drop a ball    R: reset"


def advance(world, accumulator, frame_seconds):
    """Run the fixed steps that one frame of frame_seconds owes.

    accumulator holds the seconds not simulated yet. One frame adds MAX_FRAME at most, so that a
    slow frame cannot make the next one slower still. Returns (accumulator, steps run).
    """
    # TODO 6: run whole steps from the accumulator
    accumulator += min(frame_seconds, MAX_FRAME)
    steps = 0
    while accumulator >= STEP:
        world.step(STEP)
        accumulator -= STEP
        steps += 1
    # END TODO 6
    return accumulator, steps


def pendulum_error(world):
    """How far the rod is from its length, in px."""
    rod = world.joints[0]
    return abs((rod.b.pos - rod.a.pos).length() - rod.length)


def drop_ball(world, rng, pos):
    """Drop a ball at pos, unless MAX_BALLS bodies are moving already."""
    if len(world.moving_bodies()) < MAX_BALLS:
        world.add(ball(rng, pos))


def draw(screen, font, world):
    """Draw the rods, the bodies and the two lines of text."""
    screen.fill(BACKGROUND)
    for joint in world.joints:
        pygame.draw.line(screen, INK, joint.a.pos, joint.b.pos, 3)
    for body in world.bodies:
        draw_body(screen, body)
    status = f"moving bodies: {len(world.moving_bodies())}    contacts: {len(world.contacts)}"
    screen.blit(font.render(status, True, INK), (12, 10))
    screen.blit(font.render(HELP, True, INK), (12, HEIGHT - 29))
    pygame.display.flip()


def draw_body(screen, body):
    """Draw a box, or a circle; a moving circle has a spoke that shows how it turns."""
    if isinstance(body.shape, Circle):
        radius = body.shape.radius
        spoke = Vector2(radius - 2, 0).rotate_rad(body.angle)
        pygame.draw.aacircle(screen, body.color, body.pos, radius)
        if not body.is_static:
            pygame.draw.line(screen, BACKGROUND, body.pos, body.pos + spoke, 3)
    else:
        half = body.shape.half
        pygame.draw.rect(screen, body.color, (body.pos - half, half * 2))


def main():
    """Run the lab scene until the window is closed."""
    pygame.init()
    pygame.display.set_caption("Mini engine")
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    font = pygame.font.Font(None, 26)
    clock = pygame.time.Clock()
    rng = random.Random(SEED)
    world = make_world(rng)
    accumulator = 0.0  # s
    total_steps = 0
    running = True
    while running and frame_budget():
        frame_seconds = clock.tick(60) / 1000
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
                drop_ball(world, rng, event.pos)
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                rng = random.Random(SEED)
                world = make_world(rng)
        accumulator, steps = advance(world, accumulator, frame_seconds)
        total_steps += steps
        draw(screen, font, world)
    pygame.quit()
    print(f"Fixed steps: {total_steps}")
    print(f"Pendulum length error: {pendulum_error(world):.2f} px")
