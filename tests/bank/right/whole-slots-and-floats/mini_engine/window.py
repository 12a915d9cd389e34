"""Scene and window."""

import random

import pygame
from pygame import Vector2

from lab_runtime import frame_budget

from .core import HEIGHT, MAX_BALLS, MAX_STEPS, STEP, WIDTH, Body, Box, Circle, DistanceJoint, World

def moving(world):
    return [body for body in world.bodies if not body.is_static]


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
    accumulator += frame_seconds if frame_seconds < MAX_STEPS * STEP else MAX_STEPS * STEP
    steps = int(accumulator // STEP)
    for _ in range(steps):
        world.step(STEP)
    return accumulator % STEP, steps


def draw_body(screen, body):
    if isinstance(body.shape, Box):
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
    status = f"moving bodies: {len(moving(world))}    contacts: {len(world.contacts)}"
    screen.blit(font.render(status, True, (225, 228, 235)), (12, 10))
    pygame.display.flip()


def main():
    pygame.init()
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    font = pygame.font.Font(None, 26)
    clock = pygame.time.Clock()
    rng = random.Random(12)
    world = make_world(rng)
    accumulator, total = 0.0, 0
    running = True
    while running and frame_budget():
        seconds = clock.tick(60) / 1000
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            if event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                rng = random.Random(12)
                world = make_world(rng)
            if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1 and len(moving(world)) < MAX_BALLS:
                world.add(ball(rng, event.pos))
        accumulator, steps = advance(world, accumulator, seconds)
        total += steps
        draw(screen, font, world)
    pygame.quit()
    rod = world.joints[0]
    print(f"Fixed steps: {total}")
    print(f"Pendulum length error: {abs(rod.a.pos.distance_to(rod.b.pos) - rod.length):.2f} px")
