import random

import pygame as pg
import pymunk as pm
from lab_runtime import frame_budget

STEP, MAX_STEPS, MAX_BALLS = 1 / 120, 8, 40


class LabSpace(pm.Space):
    """A space that knows the lab's gravity and counts its steps."""

    def __init__(self):
        super().__init__()
        self.gravity = 0, 980
        self.damping = 0.95
        self.steps = 0

    def step(self, dt):
        super().step(dt)
        self.steps += 1


def put(space, shape, friction, elasticity):
    shape.friction, shape.elasticity = friction, elasticity
    space.add(shape)
    return shape


def add_static_box(space, center, size):
    (x, y), (w, h) = center, size
    corners = [(x - w / 2, y - h / 2), (x + w / 2, y - h / 2), (x + w / 2, y + h / 2), (x - w / 2, y + h / 2)]
    put(space, pm.Poly(space.static_body, corners), 0.6, 0.3)


def add_ball(space, rng, pos):
    r = rng.randint(10, 22)
    ball = pm.Body(r * r / 100, pm.moment_for_circle(r * r / 100, 0, r, (0, 0)))
    ball.position = pos
    space.add(ball)
    put(space, pm.Circle(ball, r), 0.6, 0.4).color = [rng.randint(90, 240) for _ in range(3)]
    return ball


def add_box(space, pos, size=(50, 36)):
    m = size[0] * size[1] / 1000
    box = pm.Body(m, pm.moment_for_box(m, size))
    box.position = pos
    space.add(box)
    put(space, pm.Poly.create_box(box, size), 0.7, 0.1)
    return box


def make_space(rng):
    space = LabSpace()
    for center, size in (((450, 580), (900, 40)), ((-20, 300), (40, 600)), ((920, 300), (40, 600)), ((200, 260), (300, 20))):
        add_static_box(space, center, size)
    for x in range(375, 616, 60):
        put(space, pm.Circle(space.static_body, 8, (x, 400)), 0.6, 0.3)
    put(space, pm.Circle(space.static_body, 6, (700, 90)), 0.6, 0.3)
    bob = pm.Body()
    bob.position = 840, 90
    disc = pm.Circle(bob, 24)
    disc.mass = 6  # the moment follows from the shape
    space.add(bob)
    put(space, disc, 0.6, 0.2)
    space.add(pm.PinJoint(bob, space.static_body, (0, 0), (700, 90)))
    for i in range(8):
        add_ball(space, rng, (120 + 70 * i, 60 + 40 * (i % 3)))
    stack = [add_box(space, (760, 560 - 18 - 36 * i)) for i in range(4)]
    return space, stack


def draw(screen, font, space):
    screen.fill("gray10")
    for shape in space.shapes:
        if isinstance(shape, pm.Circle):
            centre = shape.body.local_to_world(shape.offset)
            pg.draw.circle(screen, getattr(shape, "color", "gray"), centre, shape.radius)
            if shape.body is not space.static_body:
                pg.draw.line(screen, "black", centre, centre + shape.body.rotation_vector * shape.radius, 2)
        else:
            corners = [shape.body.local_to_world(v) for v in shape.get_vertices()]
            pg.draw.polygon(screen, "gray", corners)
            pg.draw.polygon(screen, "black", corners, 1)
    screen.blit(font.render(f"{len(space.bodies)} bodies", True, "white"), (8, 8))
    pg.display.flip()


def main():
    pg.init()
    screen, font, clock = pg.display.set_mode((900, 600)), pg.font.Font(None, 28), pg.time.Clock()
    rng = random.Random(12)
    space, stack = make_space(rng)
    owed = total = 0
    alive = True
    while alive and frame_budget():
        for event in pg.event.get():
            if event.type == pg.QUIT:
                alive = False
            if event.type == pg.MOUSEBUTTONDOWN and event.button == 1 and len(space.bodies) < MAX_BALLS:
                add_ball(space, rng, event.pos)
            if event.type == pg.KEYDOWN and event.key == pg.K_b and len(space.bodies) < MAX_BALLS:
                add_box(space, (rng.randint(420, 700), 40))
            if event.type == pg.KEYDOWN and event.key == pg.K_r:
                total += space.steps
                rng = random.Random(12)
                space, stack = make_space(rng)
        owed += min(clock.get_time() / 1000, MAX_STEPS * STEP)
        while owed >= STEP:
            space.step(STEP)
            owed -= STEP
        draw(screen, font, space)
        clock.tick(60)
    pg.quit()
    print("Steps:", total + space.steps, "bodies:", len(space.bodies))
    print("The stack stands:", all(abs(box.angle) < 0.2 for box in stack))


if __name__ == "__main__":
    main()
