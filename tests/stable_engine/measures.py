"""What the battery measures. Lengths in px, speeds in px/s."""

import math

from scenes import DT, G, H


def run(world, seconds, dt=DT):
    """Step a world on."""
    for _ in range(round(seconds / dt)):
        world.step(dt)


def watch(world, seconds, measure, dt=DT):
    """What measure() says after each step."""
    seen = []
    for _ in range(round(seconds / dt)):
        world.step(dt)
        seen.append(measure())
    return seen


def balls(world):
    """The bodies that can move."""
    return [body for body in world.bodies if not body.is_static]


def speed(body):
    return math.hypot(body.vx, body.vy)


def top_speed(world):
    """The speed of the fastest ball."""
    return max(speed(ball) for ball in balls(world))


def overlap(a, b):
    """How deep circle a is in body b, worked out without the engine; negative when apart."""
    x, y = a.x - b.x, a.y - b.y
    out_x, out_y = abs(x) - b.hx, abs(y) - b.hy
    if b.radius:
        return a.radius + b.radius - math.hypot(x, y)
    if out_x < 0 and out_y < 0:
        return a.radius - max(out_x, out_y)
    return a.radius - math.hypot(max(out_x, 0), max(out_y, 0))


def deepest_overlap(world):
    """The deepest overlap of any two bodies, or 0."""
    moving = balls(world)
    static = [body for body in world.bodies if body.is_static]
    pairs = [(a, b) for i, a in enumerate(moving) for b in static + moving[:i]]
    return max(0.0, *(overlap(a, b) for a, b in pairs))


def stretches(world):
    """How far each rod is from its length."""
    return [abs(math.dist(r.a.pos, r.b.pos) - r.length) for r in world.effects["Rods"].joints]


def energy_height(ball):
    """Height above y = 0 that a ball could reach with its energy.

    Semi-implicit Euler's speeds lag half a substep behind its places: the speed at this moment is
    v + g h/2.
    """
    return (ball.vx**2 + (ball.vy + G * H / 2) ** 2) / (2 * G) - ball.y


def pendulum_period(length, degrees):
    """The exact period in s, by the arithmetic-geometric mean."""
    a, b = 1.0, math.cos(math.radians(degrees) / 2)
    for _ in range(8):
        a, b = (a + b) / 2, math.sqrt(a * b)
    return 2 * math.pi * math.sqrt(length / G) / a


def state(world):
    """Every number of every ball, as raw bits."""
    return [
        number.hex()
        for body in world.bodies
        for number in (body.x, body.y, body.vx, body.vy, body.angle, body.w)
    ]
