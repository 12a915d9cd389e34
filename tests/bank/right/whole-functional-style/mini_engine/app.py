"""Scene and window."""

import random

import pygame
from pygame import Vector2

from lab_runtime import frame_budget

from .data import HEIGHT, MAX_BALLS, MAX_STEPS, STEP, WIDTH, Body, Box, Circle
from .physics import DistanceJoint, World, moving

GREY = (84, 90, 104)
BOXES = [(450, 580, 450, 20), (-20, 300, 20, 300), (920, 300, 20, 300), (200, 260, 150, 10)]


def ball(rng, pos):
    radius = rng.randint(10, 22)
    return Body(Circle(radius), pos, radius**2 / 100, 0.4, 0.6, [rng.randint(90, 240) for _ in range(3)])


def make_world(rng):
    world = World()
    for x, y, w, h in BOXES:
        world.add(Body(Box((w, h)), (x, y), color=GREY))
    for x in range(375, 616, 60):
        world.add(Body(Circle(8), (x, 400), color=GREY))
    ends = Body(Circle(6), (700, 90), color=GREY), Body(Circle(24), (840, 90), 6, restitution=0.2)
    world.joints.append(DistanceJoint(*map(world.add, ends)))
    for i in range(8):
        world.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return world


def advance(world, accumulator, frame_seconds):
    def run(purse, steps):
        if purse < STEP:
            return purse, steps
        world.step(STEP)
        return run(purse - STEP, steps + 1)

    return run(accumulator + min(frame_seconds, MAX_STEPS * STEP), 0)


def draw_body(screen, body):
    if body.shape.kind == "box":
        pygame.draw.rect(screen, body.color, (body.pos - body.shape.half, 2 * body.shape.half))
        return
    pygame.draw.circle(screen, body.color, body.pos, body.shape.radius)
    if body.inv_mass:
        pygame.draw.line(screen, (0, 0, 0), body.pos, body.pos + Vector2(body.shape.radius, 0).rotate_rad(body.angle), 3)


def draw(screen, font, world):
    screen.fill((22, 25, 33))
    for joint in world.joints:
        pygame.draw.line(screen, (200, 200, 200), joint.a.pos, joint.b.pos, 3)
    for body in world.bodies:
        draw_body(screen, body)
    status = f"moving bodies: {len(list(moving(world)))}    contacts: {len(world.contacts)}"
    screen.blit(font.render(status, True, (225, 228, 235)), (12, 10))
    pygame.display.flip()


def handle(event, world, rng):
    """What an event makes of (world, rng); None ends the program."""
    match event:
        case pygame.event.Event(type=pygame.QUIT):
            return None
        case pygame.event.Event(type=pygame.MOUSEBUTTONDOWN, button=1):
            if len(list(moving(world))) < MAX_BALLS:
                world.add(ball(rng, event.pos))
        case pygame.event.Event(type=pygame.KEYDOWN, key=pygame.K_r):
            rng = random.Random(12)
            return make_world(rng), rng
    return world, rng


def main():
    pygame.init()
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    font = pygame.font.Font(None, 26)
    clock = pygame.time.Clock()
    rng = random.Random(12)
    world = make_world(rng)
    accumulator, total = 0.0, 0
    state = world, rng
    while state and frame_budget():
        seconds = clock.tick(60) / 1000
        world, rng = state
        for event in pygame.event.get():
            state = state and handle(event, *state)
        if state:
            world, rng = state
        accumulator, steps = advance(world, accumulator, seconds)
        total += steps
        draw(screen, font, world)
    pygame.quit()
    rod = world.joints[0]
    print(f"Fixed steps: {total}")
    print(f"Pendulum length error: {abs(rod.a.pos.distance_to(rod.b.pos) - rod.length):.2f} px")
