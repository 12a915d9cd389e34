"""The scene in pymunk; one clock for the whole file."""

import random

import pygame
import pymunk
from lab_runtime import frame_budget

pygame.display.init()
CLOCK = pygame.time.Clock()

STEP = 1 / 120
MAX_STEPS = 8


def empty_space():
    space = pymunk.Space()
    # TODO 7a: gravity
    space.gravity = 0, 980
    # END TODO 7a
    space.damping = 0.95
    return space


def fix(space, shape):
    shape.friction, shape.elasticity = 0.6, 0.3
    space.add(shape)


def add_static_box(space, center, size):
    x, y = center
    w, h = size[0] / 2, size[1] / 2
    corners = [(x - w, y - h), (x - w, y + h), (x + w, y + h), (x + w, y - h)]
    fix(space, pymunk.Poly(space.static_body, corners))


def add_ball(space, rng, pos):
    radius = rng.randint(10, 22)
    mass = radius**2 / 100
    # TODO 7b: the ball's moment of inertia
    moment = pymunk.moment_for_circle(mass, 0, radius, (0, 0))
    # END TODO 7b
    body = pymunk.Body(mass, moment)
    body.position = pos
    shape = pymunk.Circle(body, radius)
    shape.friction, shape.elasticity = 0.6, 0.4
    space.add(body, shape)
    return body


def add_box(space, pos, size=(50, 36)):
    mass = size[0] * size[1] / 1000
    body = pymunk.Body(mass, pymunk.moment_for_box(mass, size))
    body.position = pos
    shape = pymunk.Poly.create_box(body, size)
    shape.friction, shape.elasticity = 0.7, 0.1
    space.add(body, shape)
    return body


def add_pendulum(space):
    bob = pymunk.Body(6, pymunk.moment_for_circle(6, 0, 24))
    bob.position = 840, 90
    shape = pymunk.Circle(bob, 24)
    shape.friction, shape.elasticity = 0.6, 0.2
    space.add(bob, shape)
    fix(space, pymunk.Circle(space.static_body, 6, (700, 90)))
    # TODO 7c: a pin joint for the rod
    rod = pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0))
    space.add(rod)
    # END TODO 7c
    return bob


def make_space(rng):
    space = empty_space()
    add_static_box(space, (450, 580), (900, 40))
    add_static_box(space, (-20, 300), (40, 600))
    add_static_box(space, (920, 300), (40, 600))
    add_static_box(space, (200, 260), (300, 20))
    for i in range(5):
        fix(space, pymunk.Circle(space.static_body, 8, (375 + 60 * i, 400)))
    add_pendulum(space)
    for i in range(8):
        add_ball(space, rng, (120 + 70 * i, 60 + 40 * (i % 3)))
    return space, [add_box(space, (760, 542 - 36 * i)) for i in range(4)]


def draw(screen, font, space):
    screen.fill("black")
    for shape in space.shapes:
        if isinstance(shape, pymunk.Poly):
            corners = [shape.body.local_to_world(v) for v in shape.get_vertices()]
            pygame.draw.polygon(screen, "gray", corners)
        else:
            center = shape.body.local_to_world(shape.offset)
            rim = shape.body.local_to_world(shape.offset + (shape.radius, 0))
            pygame.draw.circle(screen, "gray", center, shape.radius)
            pygame.draw.line(screen, "black", center, rim, 2)
    screen.blit(font.render(f"moving: {len(space.bodies)}", True, "white"), (10, 10))


def handle(event, space, rng):
    """Returns whether to go on."""
    if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1 and len(space.bodies) < 40:
        add_ball(space, rng, event.pos)
    if event.type == pygame.KEYDOWN and event.key == pygame.K_b and len(space.bodies) < 40:
        add_box(space, (rng.randint(420, 700), 40))
    return event.type != pygame.QUIT


def report(steps, space, stack):
    print(f"{steps} fixed steps, {len(space.bodies)} bodies")
    print("The stack", "stands" if all(abs(box.angle) < 0.2 for box in stack) else "fell")


def main():
    pygame.init()
    screen = pygame.display.set_mode((900, 600))
    font = pygame.font.Font(None, 24)
    rng = random.Random(12)
    space, stack = make_space(rng)
    total, running = 0, True
    accumulator = 0.0
    while running and frame_budget():
        seconds = CLOCK.tick(60) / 1000
        for event in pygame.event.get():
            running = handle(event, space, rng) and running
            if event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                rng = random.Random(12)
                space, stack = make_space(rng)
        # TODO 7d: run whole steps from the accumulator
        accumulator += min(seconds, MAX_STEPS * STEP)
        while accumulator >= STEP:
            space.step(STEP)
            accumulator -= STEP
            total += 1
        # END TODO 7d
        draw(screen, font, space)
        pygame.display.flip()
    pygame.quit()
    report(total, space, stack)


if __name__ == "__main__":
    main()
