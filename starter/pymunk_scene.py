"""The lab scene in pymunk, with a stack of boxes.

Lengths are in px, times in s, angles in rad. pymunk has no "up": y grows down, as on the screen.
"""

import random
from functools import partial

import pygame
import pymunk
from pygame import Vector2

from lab_runtime import frame_budget, pause

WIDTH, HEIGHT = 900, 600  # px
STEP = 1 / 120  # s, one physics step
MAX_STEPS = 8  # most steps in one frame
MAX_FRAME = MAX_STEPS * STEP  # s, the most time one frame may add
MAX_BALLS = 40  # most moving bodies in the window
SEED = 12
BALL, PEG = 1, 2  # collision types
GREY = (84, 90, 104)
BACKGROUND = (22, 25, 33)
INK = (225, 228, 235)
HELP = "click: drop a ball    B: drop a box    R: reset    Space: pause, then N: one step"


def empty_space():
    """A space with gravity and damping and nothing in it."""
    space = pymunk.Space()
    space.damping = 0.95  # share of the velocity kept per second
    # TODO 7a: gravity
    # The same gravity as in the mini engine.
    space.gravity = (0, 0)
    # END TODO 7a
    return space


def add_shape(space, shape, friction, elasticity, color):
    """Give a shape its surface and colour, add it to the space and return it."""
    shape.friction = friction
    shape.elasticity = elasticity
    shape.color = color
    space.add(shape)
    return shape


def add_static_box(space, center, size):
    """Add a box that never moves; size is its width and height."""
    place = pymunk.Transform.translation(*center)
    corners = pymunk.Poly.create_box(None, size).get_vertices()
    add_shape(space, pymunk.Poly(space.static_body, corners, place), 0.6, 0.3, GREY)


def add_static_circle(space, center, radius):
    """Add a circle that never moves and return its shape."""
    return add_shape(space, pymunk.Circle(space.static_body, radius, center), 0.6, 0.3, GREY)


def add_ball(space, rng, pos):
    """Add a ball of random size and colour at pos and return its body; rng is a random.Random."""
    radius = rng.randint(10, 22)
    color = (rng.randint(90, 255), rng.randint(90, 255), rng.randint(90, 255))
    mass = radius**2 / 100
    # TODO 7b: the ball's moment of inertia
    # An infinite moment never turns.
    moment = float("inf")
    # END TODO 7b
    body = pymunk.Body(mass, moment)
    body.position = pos
    space.add(body)
    add_shape(space, pymunk.Circle(body, radius), 0.6, 0.4, color).collision_type = BALL
    return body


def add_box(space, pos, size=(50, 36)):
    """Add a box that can move and turn at pos and return its body; size is width and height."""
    mass = size[0] * size[1] / 1000
    body = pymunk.Body(mass, pymunk.moment_for_box(mass, size))
    body.position = pos
    space.add(body)
    add_shape(space, pymunk.Poly.create_box(body, size), 0.7, 0.1, (190, 140, 95))
    return body


def add_pendulum(space):
    """Add a heavy bob on a rod, held level at first, and return its body."""
    bob = pymunk.Body(6, pymunk.moment_for_circle(6, 0, 24))
    bob.position = (840, 90)
    space.add(bob)
    add_shape(space, pymunk.Circle(bob, 24), 0.6, 0.2, (235, 190, 80))
    add_static_circle(space, (700, 90), 6)
    # TODO 7c: a pin joint for the rod
    # Hold bob on a rod from (700, 90) on space.static_body to the bob's centre.
    # END TODO 7c
    return bob


def make_space(rng):
    """The lab scene and a stack of four boxes. Returns (space, bodies of the stack).

    space.counter counts the hits of pegs.
    """
    space = empty_space()
    add_static_box(space, (450, 580), (900, 40))
    add_static_box(space, (-20, 300), (40, 600))
    add_static_box(space, (920, 300), (40, 600))
    add_static_box(space, (200, 260), (300, 20))
    for i in range(5):
        add_static_circle(space, (375 + 60 * i, 400), 8).collision_type = PEG
    add_pendulum(space)
    for i in range(8):
        add_ball(space, rng, (120 + 70 * i, 60 + 40 * (i % 3)))
    stack = [add_box(space, (760, 542 - 36 * level)) for level in range(4)]
    space.counter = count_hits(space)
    return space, stack


def count_hits(space):
    """Count how often a ball begins to touch a peg, from now on; returns {"hits": 0} at first.

    pymunk calls a function begin(arbiter, space, data) at the begin of each touch of two shapes
    whose collision_type is BALL and PEG, with the data that was handed to space.on_collision.
    """
    data = {"hits": 0}

    # TODO B4: count the hits
    # Nothing is counted yet.
    # END TODO B4
    return data


def advance(space, accumulator, frame_seconds):
    """Run the fixed steps that one frame of frame_seconds owes.

    accumulator holds the seconds not simulated yet. One frame adds MAX_FRAME at most, so that a
    slow frame cannot make the next one slower still. Returns (accumulator, steps run).
    """
    # TODO 7d: run whole steps from the accumulator
    # One step per frame: the faster the computer draws, the faster the balls fall.
    space.step(STEP)
    steps = 1
    # END TODO 7d
    return accumulator, steps


def stack_stands(stack):
    """Return whether no box of the stack has tipped over."""
    return all(abs(box.angle) < 0.2 for box in stack)  # rad


def drop_ball(space, rng, pos):
    """Drop a ball at pos, unless MAX_BALLS bodies are moving already."""
    if len(space.bodies) < MAX_BALLS:
        add_ball(space, rng, pos)


def drop_box(space, rng):
    """Drop a box from the top at a random x, unless MAX_BALLS bodies are moving already."""
    if len(space.bodies) < MAX_BALLS:
        add_box(space, (rng.randint(420, 700), 40))


def draw(screen, font, space):
    """Draw the rods, the shapes and the two lines of text."""
    screen.fill(BACKGROUND)
    for joint in space.constraints:
        start = joint.a.local_to_world(joint.anchor_a)
        end = joint.b.local_to_world(joint.anchor_b)
        pygame.draw.line(screen, INK, start, end, 3)
    for shape in space.shapes:
        draw_shape(screen, shape)
    status = f"moving bodies: {len(space.bodies)}"
    screen.blit(font.render(status, True, INK), (12, 10))
    screen.blit(font.render(f"hits of pegs: {space.counter['hits']}", True, INK), (310, 10))
    screen.blit(font.render(f"rod error: {rod_error(space):.2f} px", True, INK), (12, 34))
    screen.blit(font.render(HELP, True, INK), (12, HEIGHT - 29))
    pygame.display.flip()


def rod_error(space):
    """Return how far the rods are from their lengths, in px."""
    rods = [joint for joint in space.constraints if isinstance(joint, pymunk.PinJoint)]
    return sum(abs(rod_length(rod) - rod.distance) for rod in rods)


def rod_length(rod):
    """Return how far the two ends of a rod are from each other, in px."""
    return rod.a.local_to_world(rod.anchor_a).get_distance(rod.b.local_to_world(rod.anchor_b))


def draw_shape(screen, shape):
    """Draw a box, or a circle; a moving circle has a spoke that shows how it turns."""
    body = shape.body
    moving = body.body_type == pymunk.Body.DYNAMIC
    if isinstance(shape, pymunk.Circle):
        center = Vector2(body.local_to_world(shape.offset))
        spoke = Vector2(shape.radius - 2, 0).rotate_rad(body.angle)
        pygame.draw.aacircle(screen, shape.color, center, shape.radius)
        if moving:
            pygame.draw.line(screen, BACKGROUND, center, center + spoke, 3)
    else:
        corners = [body.local_to_world(corner) for corner in shape.get_vertices()]
        pygame.draw.polygon(screen, shape.color, corners)
        if moving:
            pygame.draw.polygon(screen, BACKGROUND, corners, 2)


def main():
    """Run the lab scene until the window is closed."""
    pygame.init()
    pygame.display.set_caption("The same scene in pymunk")
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    font = pygame.font.Font(None, 26)
    clock = pygame.time.Clock()
    rng = random.Random(SEED)
    space, stack = make_space(rng)
    accumulator = 0.0  # s
    total_steps = 0
    running = True
    while running and frame_budget():
        frame_seconds = clock.tick(60) / 1000
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
                drop_ball(space, rng, event.pos)
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_SPACE:
                pause(partial(space.step, STEP), partial(draw, screen, font, space))
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_b:
                drop_box(space, rng)
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                rng = random.Random(SEED)
                space, stack = make_space(rng)
        accumulator, steps = advance(space, accumulator, frame_seconds)
        total_steps += steps
        draw(screen, font, space)
    pygame.quit()
    print(f"Fixed steps: {total_steps}")
    print(f"Bodies: {len(space.bodies)}")
    print(f"Box stack stands: {'yes' if stack_stands(stack) else 'no'}")


if __name__ == "__main__":
    main()
