"""Lab scene in pymunk."""
import random
import pygame, pymunk
from lab_runtime import frame_budget

WIDTH, HEIGHT, STEP, MAX_STEPS, MAX_BALLS, GREY = 900, 600, 1 / 120, 8, 40, (84, 90, 104)


def dress(space, shape, friction, elasticity, color):
    shape.friction, shape.elasticity, shape.color = friction, elasticity, color
    space.add(shape)
    return shape


def add_static_box(space, center, size):
    (x, y), w, h = center, size[0] / 2, size[1] / 2
    dress(space, pymunk.Poly(space.static_body, [(x - w, y - h), (x + w, y - h), (x + w, y + h), (x - w, y + h)]), 0.6, 0.3, GREY)


def add_ball(space, rng, pos):
    r = rng.randint(10, 22)
    color = tuple(rng.randint(90, 240) for _ in range(3))
    body = pymunk.Body(r * r / 100, r**4 / 200)
    body.position = pos
    space.add(body)
    dress(space, pymunk.Circle(body, r), 0.6, 0.4, color)
    return body


def add_box(space, pos, size=(50, 36)):
    m = size[0] * size[1] / 1000
    body = pymunk.Body(m, m * (size[0]**2 + size[1]**2) / 12)
    body.position = pos
    space.add(body)
    dress(space, pymunk.Poly.create_box(body, size), 0.7, 0.1, (190, 140, 95))
    return body


def make_space(rng):
    space = pymunk.Space()
    space.gravity, space.damping = (0, 980), 0.95
    for c, s in ((450, 580), (900, 40)), ((-20, 300), (40, 600)), ((920, 300), (40, 600)), ((200, 260), (300, 20)):
        add_static_box(space, c, s)
    for x, y, r in [(375 + 60 * i, 400, 8) for i in range(5)] + [(700, 90, 6)]:
        dress(space, pymunk.Circle(space.static_body, r, (x, y)), 0.6, 0.3, GREY)
    bob = pymunk.Body(6, pymunk.moment_for_circle(6, 0, 24))
    bob.position = 840, 90
    space.add(bob, pymunk.PinJoint(space.static_body, bob, (700, 90)))
    dress(space, pymunk.Circle(bob, 24), 0.6, 0.2, (235, 190, 80))
    for i in range(8): add_ball(space, rng, (120 + 70 * i, 60 + 40 * (i % 3)))
    return space, [add_box(space, (760, 542 - 36 * i)) for i in range(4)]


def advance(space, accumulator, frame_seconds):
    n, rest = divmod(accumulator + min(frame_seconds, MAX_STEPS * STEP), STEP)
    for _ in range(int(n)): space.step(STEP)
    return rest, int(n)


def draw(screen, font, space):
    screen.fill((22, 25, 33))
    for j in space.constraints: pygame.draw.line(screen, "white", j.a.local_to_world(j.anchor_a), j.b.local_to_world(j.anchor_b), 3)
    for s in space.shapes:
        if isinstance(s, pymunk.Poly): pygame.draw.polygon(screen, s.color, [s.body.local_to_world(v) for v in s.get_vertices()])
        else:
            c = s.body.local_to_world(s.offset)
            pygame.draw.circle(screen, s.color, c, s.radius)
            if s.body is not space.static_body: pygame.draw.line(screen, "black", c, c + pymunk.Vec2d(s.radius, 0).rotated(s.body.angle), 3)
    screen.blit(font.render(f"moving bodies: {len(space.bodies)}", True, "white"), (12, 10))
    pygame.display.flip()


def main():
    pygame.init()
    screen, font, clock = pygame.display.set_mode((WIDTH, HEIGHT)), pygame.font.Font(None, 26), pygame.time.Clock()
    rng = random.Random(12)
    (space, stack), acc, n, on = make_space(rng), 0.0, 0, True
    while on and frame_budget():
        seconds = clock.tick(60) / 1000
        for e in pygame.event.get():
            if e.type == pygame.QUIT: on = False
            room = len(space.bodies) < MAX_BALLS
            if e.type == pygame.MOUSEBUTTONDOWN and e.button == 1 and room: add_ball(space, rng, e.pos)
            if e.type == pygame.KEYDOWN and e.key == pygame.K_b and room: add_box(space, (rng.randint(420, 700), 40))
            if e.type == pygame.KEYDOWN and e.key == pygame.K_r: space, stack = make_space(rng := random.Random(12))
        acc, k = advance(space, acc, seconds)
        n += k
        draw(screen, font, space)
    pygame.quit()
    print(f"Fixed steps: {n}\nBodies: {len(space.bodies)}\nBox stack stands: {'yes' if all(abs(b.angle) < 0.2 for b in stack) else 'no'}")


if __name__ == "__main__": main()
