"""Try an engine in a case, and measure what it does.

Each trial takes a bench (battery.py), which builds engines and says for how long (s) and in which
steps (s) to run them, and a scene. It returns figures by name. Lengths in px, speeds in px/s.
"""

import math
from dataclasses import replace
from itertools import repeat

from .measures import (
    GaveUp,
    bits,
    deepest_overlap,
    energy,
    energy_height,
    finite,
    overlap,
    run,
    sinking,
    speed,
    states,
    stretches,
    swing_energy,
    top_speed,
    watch,
    worst_stretch,
)
from .scenes import G, shuffled
from .steps import lasting

SLIP = 0.07  # °: 1 px/s of slip in 1 s takes a slope 0.06 ° too steep; 0.01 for halving

# ---------------------------------------------------------------- contacts


def settle(bench, scene):
    """Return how far the top ball sinks, how high it ever rises, and the top speed at the end."""
    sink, rise, fastest = sinking(bench.build(scene), bench.seconds, bench.dt)
    return {"sink": sink, "rise": rise, "speed": fastest}


def vary(bench, scene, steps):
    """Return how high any ball ever rises above its start, in steps that vary."""
    engine, moving = bench.build(scene), scene.moving()
    starts = [engine.read(i).y for i in moving]
    rise = 0.0
    for dt in lasting(bench.seconds, steps()):
        engine.step(dt)
        rise = max(rise, *[y - engine.read(i).y for i, y in zip(moving, starts, strict=True)])
    return {"rise": rise}


def overlaps(bench, scene):
    """Return the deepest overlap in the end."""
    engine = bench.build(scene)
    run(engine, bench.seconds, bench.dt)
    return {"overlap": deepest_overlap(engine)}


def separate(bench, scene):
    """Return the top speed on the way, the overlap left, and how far the balls are spread.

    spread is the narrower side of the box around all centres.
    """
    engine = bench.build(scene)
    speeds = watch(engine, bench.seconds, lambda: top_speed(engine), bench.dt)
    ends = [engine.read(i) for i in scene.moving()]
    sides = [max(places) - min(places) for places in zip(*[(s.x, s.y) for s in ends], strict=True)]
    return {"speed": max(speeds), "overlap": deepest_overlap(engine), "spread": min(sides)}


def rest(bench, scene):
    """Return where a ball on a floor is after a second, and how far it has drifted later."""
    engine = bench.build(scene)
    floor, ball = scene.bodies
    run(engine, 1, bench.dt)
    before = engine.read(1)
    run(engine, bench.seconds, bench.dt)
    after = engine.read(1)
    depth = overlap(ball, after, floor, engine.read(0))
    turned = ball.radius * abs(after.angle - before.angle)
    drift = max(math.hypot(after.x - before.x, after.y - before.y), turned)
    return {"drift": drift, "depth": depth, "share": depth / ball.radius, "speed": speed(after)}


def escape(bench, scene, steps=None):
    """Return 1 if a ball gets out of the closed box or a number is lost, else 0.

    A ball is out when it is all inside a wall, or beyond, after any step, or its centre in the end.
    """
    engine = bench.build(scene)
    depths = []
    try:
        for dt in lasting(bench.seconds, steps() if steps else repeat(bench.dt)):
            engine.step(dt)
            depths.append(depth_in_walls(engine))
    except ValueError:
        return {"escapes": 1}
    return {"escapes": 0 if max(depths) < 1 and depths[-1] < 0 else 1}


def depth_in_walls(engine):
    """Return how deep the centre of any ball is in the walls of a closed box, in radii."""
    bodies = engine.scene.bodies
    half = bodies[3].pos[0] - bodies[3].half[0]
    found = [(engine.read(i), bodies[i].radius) for i in engine.scene.moving()]
    return max((max(abs(at.x), abs(at.y)) - half) / radius for at, radius in found)


# ---------------------------------------------------------------- fast balls


def shoot(bench, scene):
    """Return 1 if the bullet ends up beyond the ledge, else 0."""
    engine = bench.build(scene)
    run(engine, bench.seconds, bench.dt)
    ledge = scene.bodies[0]
    return {"through": 1 if engine.read(1).y > ledge.pos[1] + ledge.half[1] else 0}


def ram(bench, scene):
    """Return 1 if a ball is beyond the wall in the end, else 0."""
    engine = bench.build(scene)
    run(engine, bench.seconds, bench.dt)
    return {"through": 1 if max(engine.read(i).x for i in scene.moving()) > 0 else 0}


def graze(bench, scene):
    """Return the share of its speed by which a ball that flies past a ledge is deflected."""
    engine = bench.build(scene)
    vx, vy = scene.bodies[1].vel
    fast = math.hypot(vx, vy)
    run(engine, math.ceil(300 / fast / bench.dt) * bench.dt, bench.dt)
    after = engine.read(1)
    return {"deflection": math.hypot(after.vx - vx, after.vy - vy) / fast}


# ---------------------------------------------------------------- bouncing


def bounce_on(bench, scene):
    """Return the height of the last apex, as a share of the first."""
    engine = bench.build(scene)
    start, radius = energy_height(engine, 1, bench.dt), scene.bodies[1].radius
    run(engine, bench.seconds - 2, bench.dt)
    seen = watch(
        engine, 2, lambda: (energy_height(engine, 1, bench.dt), engine.read(1).y), bench.dt
    )
    apex = min(seen, key=lambda pair: pair[1])[0]
    return {"apex": (apex - radius) / (start - radius)}


def bounce_once(bench, scene):
    """Return the height of the first rebound as a share of the exact height."""
    engine = bench.build(scene)
    start, radius = energy_height(engine, 1, bench.dt), scene.bodies[1].radius
    apex, hit = radius, False
    for _ in range(round(bench.seconds / bench.dt)):
        engine.step(bench.dt)
        if engine.read(1).vy < 0:
            hit, apex = True, energy_height(engine, 1, bench.dt)
        elif hit:
            break
    return {"rebound": (apex - radius) / (start - radius) / scene.exact["rebound"]}


def cradle_transfer(bench, scene):
    """Return the worst error of any ball's speed: the last ball should have all of it."""
    engine = bench.build(scene)
    run(engine, bench.seconds, bench.dt)
    speeds = [state.vx for state in states(engine)]
    exact = [0.0] * (len(speeds) - 1) + [scene.exact["last"]]
    return {"error": max(abs(a - b) for a, b in zip(speeds, exact, strict=True))}


# ---------------------------------------------------------------- rolling


def roll(bench, scene):
    """Return a ball's speed at the end, and how much faster its centre is than its rim."""
    engine, ball = bench.build(scene), scene.bodies[1]
    run(engine, bench.seconds, bench.dt)
    after = engine.read(1)
    return {"speed": after.vx, "slip": after.vx - after.omega * ball.radius}


def slip_angle(bench, scene):
    """Return the slope (degrees) from which a ball slides, less that at which its tangent is 3 μ.

    It slides once its centre gets 1 px/s faster than its rim. The search halves the slopes that are
    left; the scene's gravity is turned to make a slope.
    """
    rolls, slides = 0.0, 90.0
    while slides - rolls > 0.01:
        degrees = (rolls + slides) / 2
        angle = math.radians(degrees)
        tilted = replace(scene, gravity=(G * math.sin(angle), G * math.cos(angle)))
        if roll(bench, tilted)["slip"] > 1:
            slides = degrees
        else:
            rolls = degrees
    exact = math.degrees(math.atan(3 * scene.bodies[1].friction))
    return {"off": (rolls + slides) / 2 - exact}


def roll_over_seams(bench, scene):
    """Return how high a ball ever hops above the floor it rolls on."""
    engine, ball = bench.build(scene), scene.bodies[-1]
    i, seconds = len(scene.bodies) - 1, min(bench.seconds, 3000 / ball.vel[0])
    heights = watch(engine, seconds, lambda: -ball.radius - engine.read(i).y, bench.dt)
    return {"hop": max(0.0, *heights)}


# ---------------------------------------------------------------- rods and springs


def swing(bench, scene):
    """Return a pendulum's largest stretch, and the errors of its mean period and of its energy.

    The errors are shares: of the exact period, and of the energy between the lowest position and
    that of the peg. The bob is body 1 and the peg at x = 0.
    """
    engine, dt = bench.build(scene), bench.dt
    start, x = energy_height(engine, 1, dt), engine.read(1).x
    stretch, change, passages = 0.0, 0.0, []
    for i in range(round(bench.seconds / dt)):
        engine.step(dt)
        before, x = x, engine.read(1).x
        if x <= 0 < before:
            passages.append((i + before / (before - x)) * dt)
        stretch = max(stretch, worst_stretch(engine))
        change = max(change, energy_height(engine, 1, dt) - start, key=abs)
    if len(passages) < 2:
        raise GaveUp("never")
    period = (passages[-1] - passages[0]) / (len(passages) - 1)
    length = math.dist(scene.bodies[0].pos, scene.bodies[1].pos)
    error = period / scene.exact["period"] - 1
    return {"stretch": stretch, "period": error, "energy": change / length}


def hang_chain(bench, scene):
    """Return a chain's largest stretch of a link on the way, and of the whole at the end."""
    engine = bench.build(scene)
    worst = watch(engine, bench.seconds, lambda: worst_stretch(engine), bench.dt)
    return {"worst": max(worst), "whole": sum(stretches(engine))}


def swing_on(bench, scene):
    """Return the most energy that a swinging chain gains, and the mean of the last second.

    Both are shares of the energy that it is let go with.
    """
    engine = bench.build(scene)
    start = swing_energy(engine, bench.dt)
    seen = watch(engine, bench.seconds, lambda: swing_energy(engine, bench.dt), bench.dt)
    last = seen[-round(1 / bench.dt) :]
    return {"gain": max(seen) / start - 1, "kept": sum(last) / len(last) / start}


def oscillate(bench, scene):
    """Return how far a ball on a spring swings, as a share of how far it was pulled out."""
    engine, length = bench.build(scene), scene.springs[0].length
    swings = watch(engine, bench.seconds, lambda: abs(engine.read(1).x - length), bench.dt)
    if not finite(engine):
        raise GaveUp("NaN")
    swing = max(swings) / scene.exact["swing"]
    return {"swing": swing, "gain": max(swing - 1, 0.0)}


def ring_down(bench, scene):
    """Return a spring's mean energy in the last second, as a share of the first energy."""
    engine = bench.build(scene)
    start = energy(engine, bench.dt)
    run(engine, bench.seconds - 1, bench.dt)
    energies = watch(engine, 1, lambda: energy(engine, bench.dt), bench.dt)
    return {"energy": sum(energies) / len(energies) / start}


# ---------------------------------------------------------------- once more


def run_twice(bench, scene):
    """Count the numbers that differ in any bit when the same run is done again."""
    first, second = bench.build(scene), bench.build(scene)
    for engine in (first, second):
        run(engine, bench.seconds, bench.dt)
    return {"bits": sum(a != b for a, b in zip(bits(first), bits(second), strict=True))}


def reorder(bench, scene):
    """Return how far any ball ends up from where it does with bodies added in another order."""
    other, order = shuffled(scene)
    first, second = bench.build(scene), bench.build(other)
    for engine in (first, second):
        run(engine, bench.seconds, bench.dt)
    pairs = [(first.read(i), second.read(j)) for j, i in enumerate(order)]
    return {"shift": max(math.hypot(a.x - b.x, a.y - b.y) for a, b in pairs)}
