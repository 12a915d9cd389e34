"""The scene of the mini engine in pymunk, with a stack of boxes."""

import random

import pygame
import pymunk

from lab_runtime import frame_budget

WIDTH, HEIGHT = 900, 600  # px
STEP = 1 / 120  # s
MAX_STEPS = 8  # in one frame
GREY = (95, 100, 112)


def add_static_box(space, center, size):
    """Add a static box."""
    (x, y), (w, h) = center, size
    corners = [
        (x - w / 2, y - h / 2),
        (x + w / 2, y - h / 2),
        (x + w / 2, y + h / 2),
        (x - w / 2, y + h / 2),
    ]
    shape = pymunk.Poly(space.static_body, corners)
    shape.friction = 0.6
    shape.elasticity = 0.3
    shape.color = (*GREY, 255)
    space.add(shape)
    return shape


def add_ball(space, rng, pos):
    """Add a ball of random size and colour."""
    radius = rng.randint(10, 22)
    mass = radius**2 / 100
    body = pymunk.Body(mass, pymunk.moment_for_circle(mass, 0, radius))
    body.position = pos
    shape = pymunk.Circle(body, radius)
    shape.friction = 0.6
    shape.elasticity = 0.4
    shape.color = (rng.randint(90, 255), rng.randint(90, 255), rng.randint(90, 255), 255)
    space.add(body, shape)
    return body


def add_box(space, pos, size=(50, 36)):
    """Add a box that can move and turn."""
    mass = size[0] * size[1] / 1000
    body = pymunk.Body(mass, pymunk.moment_for_box(mass, size))
    body.position = pos
    shape = pymunk.Poly.create_box(body, size)
    shape.friction = 0.7
    shape.elasticity = 0.1
    shape.color = (200, 140, 90, 255)
    space.add(body, shape)
    return body


def make_space(rng):
    """Return the lab scene and the bodies of its stack."""
    space = pymunk.Space()
    space.gravity = (0, 980)
    space.damping = 0.95
    add_static_box(space, (450, 580), (900, 40))  # floor
    add_static_box(space, (-20, 300), (40, 600))  # walls
    add_static_box(space, (920, 300), (40, 600))
    add_static_box(space, (200, 260), (300, 20))  # ledge
    for i in range(5):  # pegs
        peg = pymunk.Circle(space.static_body, 8, offset=(375 + 60 * i, 400))
        peg.friction = 0.6
        peg.elasticity = 0.3
        peg.color = (*GREY, 255)
        space.add(peg)

    bob = pymunk.Body(6, pymunk.moment_for_circle(6, 0, 24))
    bob.position = (840, 90)
    disc = pymunk.Circle(bob, 24)
    disc.friction = 0.6
    disc.elasticity = 0.2
    disc.color = (250, 200, 90, 255)
    space.add(bob, disc)
    space.add(pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0)))

    for i in range(8):
        add_ball(space, rng, (120 + 70 * i, 60 + 40 * (i % 3)))
    stack = [add_box(space, (760, 542 - 36 * level)) for level in range(4)]
    return space, stack


def draw(screen, font, space):
    """Draw every shape and joint of the space."""
    screen.fill((24, 26, 32))
    for joint in space.constraints:
        start = joint.a.local_to_world(joint.anchor_a)
        end = joint.b.local_to_world(joint.anchor_b)
        pygame.draw.line(screen, (230, 230, 230), start, end, 3)
    for shape in space.shapes:
        body = shape.body
        if isinstance(shape, pymunk.Circle):
            center = body.local_to_world(shape.offset)
            pygame.draw.circle(screen, shape.color, center, shape.radius)
            if body.body_type == pymunk.Body.DYNAMIC:
                rim = body.local_to_world((shape.radius, 0))
                pygame.draw.line(screen, (24, 26, 32), center, rim, 2)
        else:
            corners = [body.local_to_world(corner) for corner in shape.get_vertices()]
            pygame.draw.polygon(screen, shape.color, corners)
            if body.body_type == pymunk.Body.DYNAMIC:
                pygame.draw.polygon(screen, (24, 26, 32), corners, 2)
    text = f"bodies: {len(space.bodies)}   click: ball   B: box   R: reset"
    screen.blit(font.render(text, True, (230, 230, 230)), (12, 10))
    pygame.display.flip()


def main():
    """Run the scene in a window."""
    pygame.init()
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    pygame.display.set_caption("pymunk scene")
    font = pygame.font.Font(None, 24)
    clock = pygame.time.Clock()
    rng = random.Random(12)
    space, stack = make_space(rng)
    accumulator = 0.0
    steps = 0
    running = True
    while running and frame_budget():
        accumulator += min(clock.tick(60) / 1000, MAX_STEPS * STEP)
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
                add_ball(space, rng, event.pos)
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_b:
                add_box(space, (rng.randint(420, 700), 40))
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                space, stack = make_space(rng)
        while accumulator >= STEP:
            space.step(STEP)
            accumulator -= STEP
            steps += 1
        draw(screen, font, space)
    pygame.quit()
    standing = all(abs(box.angle) < 0.2 for box in stack)
    print(f"Ran {steps} pymunk steps with {len(space.bodies)} bodies")
    print(f"Box stack standing: {standing}")


if __name__ == "__main__":
    main()
