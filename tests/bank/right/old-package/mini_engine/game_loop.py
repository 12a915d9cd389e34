"""The window: time, events, drawing. TODO 6 lives in advance, B5 in between, B6 in heaviness."""

import random

import pygame
from pygame import Vector2

from lab_runtime import frame_budget

from .broad_phase import CELL
from .constants import HEIGHT, MAX_BALLS, MAX_STEPS, STEP, WIDTH
from .scenes import add_spring, ball, make_world
from .shapes import Circle
from .sleeping import wake

MAX_FRAME = MAX_STEPS * STEP  # s, the most time one frame may add
SEED = 12
BACKGROUND = (22, 25, 33)
INK = (225, 228, 235)
FAINT = (44, 49, 61)
SLEEPER = (120, 120, 120)
HELP = "click: drop a ball    R: reset"
BONUS_HELP = "bonus:  Shift+click: a heavy ball    S: sleep    G: grid    K: a spring"


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


def heaviness():
    """How many times as heavy as usual the next ball is: 10 while Shift is held, else 1."""
    # TODO B6: heavier balls with Shift
    return 10 if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
    # END TODO B6


def drop_ball(world, rng, pos):
    """Drop a ball at pos, unless MAX_BALLS bodies are moving or asleep already."""
    if len(world.moving_bodies()) + sleepers(world) < MAX_BALLS:
        world.add(ball(rng, pos, heaviness()))


def sleepers(world):
    """How many bodies are asleep."""
    return sum(body.asleep for body in world.bodies)


def between(body, share):
    """Where to draw a body, (place, angle): so much of its way through the latest step.

    share is from 0, where it was before that step (body.before), to 1, where it is now. The body
    itself stays as it is.
    """
    # TODO B5: draw between steps
    pos, angle = body.before
    return pos + (body.pos - pos) * share, angle + (body.angle - angle) * share
    # END TODO B5


def draw(screen, font, world):
    """Draw the rods, the springs, the bodies and the lines of text."""
    screen.fill(BACKGROUND)
    if world.grid:
        draw_cells(screen)
    for joint in world.joints + world.springs:
        ends = [between(end, world.drawn)[0] for end in (joint.a, joint.b)]
        pygame.draw.line(screen, INK, *ends, 3 if joint in world.joints else 1)
    for body in world.bodies:
        draw_body(screen, body, world.drawn)
    status = f"moving bodies: {len(world.moving_bodies())}    contacts: {len(world.contacts)}"
    screen.blit(font.render(status, True, INK), (12, 10))
    if world.sleeping:
        screen.blit(font.render(f"asleep: {sleepers(world)}", True, INK), (310, 10))
    screen.blit(font.render(HELP, True, INK), (12, HEIGHT - 29))
    screen.blit(font.render(BONUS_HELP, True, INK), (310, HEIGHT - 29))
    pygame.display.flip()


def draw_cells(screen):
    """Draw the cells of the grid."""
    for x in range(0, WIDTH, CELL):
        pygame.draw.line(screen, FAINT, (x, 0), (x, HEIGHT))
    for y in range(0, HEIGHT, CELL):
        pygame.draw.line(screen, FAINT, (0, y), (WIDTH, y))


def draw_body(screen, body, share=1.0):
    """Draw a box, or a circle; one that can move has a spoke, one asleep is grey."""
    if isinstance(body.shape, Circle):
        radius = body.shape.radius
        pos, angle = between(body, share)
        spoke = Vector2(radius - 2, 0).rotate_rad(angle)
        pygame.draw.aacircle(screen, SLEEPER if body.asleep else body.color, pos, radius)
        if body.asleep or not body.is_static:
            pygame.draw.line(screen, BACKGROUND, pos, pos + spoke, 3)
    else:
        half = body.shape.half
        pygame.draw.rect(screen, body.color, (body.pos - half, half * 2))


def switch(world, key):
    """What the keys of the bonus tasks do: sleep and grid on or off, one more spring."""
    if key == pygame.K_s:
        world.sleeping = not world.sleeping
        for body in world.bodies:
            if body.asleep:
                wake(body)
    elif key == pygame.K_g:
        world.grid = not world.grid
    elif key == pygame.K_k:
        add_spring(world)


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
            elif event.type == pygame.KEYDOWN:
                switch(world, event.key)
        accumulator, steps = advance(world, accumulator, frame_seconds)
        total_steps += steps
        world.drawn = accumulator / STEP
        draw(screen, font, world)
    pygame.quit()
    print(f"Fixed steps: {total_steps}")
    print(f"Pendulum length error: {pendulum_error(world):.2f} px")
