"""What is done to an engine in a case, and what is measured then.

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
    swinging,
    top_speed,
    watch,
    worst_stretch,
)
from .scenes import G, shuffled, tower
from .steps import lasting

# ---------------------------------------------------------------- contacts


def settle(bench, scene):
    """How far the top ball sinks, how high it ever rises, how fast anybody is in the end."""
    sink, rise, fastest = sinking(bench.build(scene), bench.seconds, bench.dt)
    return {"sink": sink, "rise": rise, "speed": fastest}


def vary(bench, scene, steps):
    """How high any ball ever rises above where it starts, while steps vary as steps() says."""
    engine, moving = bench.build(scene), scene.moving()
    starts = [engine.read(i).y for i in moving]
    rise = 0.0
    for dt in lasting(bench.seconds, steps()):
        engine.step(dt)
        rise = max(rise, *[y - engine.read(i).y for i, y in zip(moving, starts, strict=True)])
    return {"rise": rise}


def overlaps(bench, scene):
    """The deepest overlap in the end."""
    engine = bench.build(scene)
    run(engine, bench.seconds, bench.dt)
    return {"overlap": deepest_overlap(engine)}


def separate(bench, scene):
    """The top speed on the way, the overlap that is left, and how wide the balls are spread.

    spread is the narrower side of the box around all centres.
    """
    engine = bench.build(scene)
    speeds = watch(engine, bench.seconds, lambda: top_speed(engine), bench.dt)
    ends = [engine.read(i) for i in scene.moving()]
    sides = [max(places) - min(places) for places in zip(*[(s.x, s.y) for s in ends], strict=True)]
    return {"speed": max(speeds), "overlap": deepest_overlap(engine), "spread": min(sides)}


def rest(bench, scene):
    """Where a ball on a floor is after a second, and how far it has drifted later on."""
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
    """1 if a ball gets out of the closed box or a number is lost, else 0; in equal steps or these.

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
    """How deep the centre of any ball is in the walls of a closed box, in radii of the ball."""
    bodies = engine.scene.bodies
    half = bodies[3].pos[0] - bodies[3].half[0]
    found = [(engine.read(i), bodies[i].radius) for i in engine.scene.moving()]
    return max((max(abs(at.x), abs(at.y)) - half) / radius for at, radius in found)


def crash(bench, scene):
    """How deep a ball that falls on a floor ever overlaps it, and how deep in the end."""
    engine = bench.build(scene)
    depths = watch(engine, bench.seconds, lambda: deepest_overlap(engine), bench.dt)
    return {"deepest": max(depths), "left": depths[-1]}


def tallest(bench, scene, most=64):
    """How many equal balls can lie on each other until the top sinks by 1 px or does not rest.

    A search by halves; the scene is only the smallest such tower. At most 64 balls are tried.
    """
    stands, falls = 0, most
    while falls - stands > 1:
        count = stands + 1 if stands == 0 else min(2 * stands, (stands + falls) // 2)
        found = settle(bench, tower(count))
        if abs(found["sink"]) < 1 and found["rise"] < 1 and found["speed"] < 1:
            stands = count
        else:
            falls = count
    return {"count": stands}


# ---------------------------------------------------------------- fast balls


def shoot(bench, scene):
    """1 if the bullet ends up beyond the ledge, else 0."""
    engine = bench.build(scene)
    run(engine, bench.seconds, bench.dt)
    ledge = scene.bodies[0]
    return {"through": 1 if engine.read(1).y > ledge.pos[1] + ledge.half[1] else 0}


def ram(bench, scene):
    """1 if a ball is beyond the wall in the end, else 0."""
    engine = bench.build(scene)
    run(engine, bench.seconds, bench.dt)
    return {"through": 1 if max(engine.read(i).x for i in scene.moving()) > 0 else 0}


def graze(bench, scene):
    """By what share of its speed a ball that flies 300 px, past a ledge, is deflected."""
    engine = bench.build(scene)
    vx, vy = scene.bodies[1].vel
    fast = math.hypot(vx, vy)
    run(engine, math.ceil(300 / fast / bench.dt) * bench.dt, bench.dt)
    after = engine.read(1)
    return {"deflection": math.hypot(after.vx - vx, after.vy - vy) / fast}


# ---------------------------------------------------------------- bouncing


def bounce_on(bench, scene):
    """The height of the last apex, as a share of the height the ball fell from at first."""
    engine = bench.build(scene)
    start, radius = energy_height(engine, 1, bench.dt), scene.bodies[1].radius
    run(engine, bench.seconds - 2, bench.dt)
    seen = watch(
        engine, 2, lambda: (energy_height(engine, 1, bench.dt), engine.read(1).y), bench.dt
    )
    apex = min(seen, key=lambda pair: pair[1])[0]
    return {"apex": (apex - radius) / (start - radius)}


def bounce_once(bench, scene):
    """The height of the first rebound as a share of the height, and that over the exact share."""
    engine = bench.build(scene)
    start, radius = energy_height(engine, 1, bench.dt), scene.bodies[1].radius
    apex, hit = radius, False
    for _ in range(round(bench.seconds / bench.dt)):
        engine.step(bench.dt)
        if engine.read(1).vy < 0:
            hit, apex = True, energy_height(engine, 1, bench.dt)
        elif hit:
            break
    share = (apex - radius) / (start - radius)
    return {"share": share, "rebound": share / (scene.exact["rebound"] or 1)}


def cradle_transfer(bench, scene):
    """How far any ball of a cradle is from the speed it should have: the last has all of it."""
    engine = bench.build(scene)
    run(engine, bench.seconds, bench.dt)
    speeds = [state.vx for state in states(engine)]
    exact = [0.0] * (len(speeds) - 1) + [scene.exact["last"]]
    return {"error": max(abs(a - b) for a, b in zip(speeds, exact, strict=True))}


# ---------------------------------------------------------------- rolling


def roll(bench, scene):
    """A ball's speed in the end, and how much faster the centre is than the rim turns."""
    engine, ball = bench.build(scene), scene.bodies[1]
    run(engine, bench.seconds, bench.dt)
    after = engine.read(1)
    return {"speed": after.vx, "slip": after.vx - after.omega * ball.radius}


def slip_angle(bench, scene):
    """The slope (degrees) from which a ball slides: its centre gets 1 px/s faster than its rim.

    A search by halves; the scene's gravity is turned to make the slope.
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
    return {"degrees": (rolls + slides) / 2}


def fall(bench, scene):
    """How far off a ball is after free fall, and how far beyond what its integrator is known for.

    Semi-implicit Euler takes each step at the speed of its end, pymunk at that of its start: half
    a step too far, or too little, at the final speed.
    """
    engine = bench.build(scene)
    run(engine, bench.seconds, bench.dt)
    error = engine.read(0).y - scene.exact["fallen"]
    known = G * bench.seconds * engine.lag(bench.dt)
    return {"error": error, "beyond": error - known}


def roll_over_seams(bench, scene):
    """How high a ball ever hops above the floor it rolls on."""
    engine, ball = bench.build(scene), scene.bodies[-1]
    i, seconds = len(scene.bodies) - 1, min(bench.seconds, 3000 / ball.vel[0])
    heights = watch(engine, seconds, lambda: -ball.radius - engine.read(i).y, bench.dt)
    return {"hop": max(0.0, *heights)}


# ---------------------------------------------------------------- rods and springs


def swing(bench, scene):
    """A pendulum's largest stretch, the error of its period and the largest error of its energy.

    The last two are shares: of the exact period, and of the energy between the lowest place and
    that of the peg.
    """
    stretch, period, change = swinging(bench.build(scene), bench.seconds, bench.dt)
    if period is None:
        raise GaveUp("never")
    length = math.dist(scene.bodies[0].pos, scene.bodies[1].pos)
    error = period / scene.exact["period"] - 1
    return {"stretch": stretch, "period": error, "energy": change / length}


def hang_chain(bench, scene):
    """A chain's largest stretch of one link on the way, and of the whole chain in the end."""
    engine = bench.build(scene)
    worst = watch(engine, bench.seconds, lambda: worst_stretch(engine), bench.dt)
    return {"worst": max(worst), "whole": sum(stretches(engine))}


def swing_on(bench, scene):
    """The most energy a swinging chain ever has, as a share of what it is let go with, less 1."""
    engine = bench.build(scene)
    start = swing_energy(engine, bench.dt)
    seen = watch(engine, bench.seconds, lambda: swing_energy(engine, bench.dt), bench.dt)
    return {"gain": max(seen) / start - 1}


def oscillate(bench, scene):
    """How far a ball on a spring swings, as a share of how far it was pulled out at first."""
    engine, length = bench.build(scene), scene.springs[0].length
    swings = watch(engine, bench.seconds, lambda: abs(engine.read(1).x - length), bench.dt)
    if not finite(engine):
        raise GaveUp("NaN")
    swing = max(swings) / scene.exact["swing"]
    return {"swing": swing, "gain": max(swing - 1, 0.0)}


def ring_down(bench, scene):
    """The mean energy of a spring during the last second, as a share of the energy at first."""
    engine = bench.build(scene)
    start = energy(engine, bench.dt)
    run(engine, bench.seconds - 1, bench.dt)
    energies = watch(engine, 1, lambda: energy(engine, bench.dt), bench.dt)
    return {"energy": sum(energies) / len(energies) / start}


# ---------------------------------------------------------------- once more


def run_twice(bench, scene):
    """How many numbers differ, be it in their last bit, when the same run is done again."""
    first, second = bench.build(scene), bench.build(scene)
    for engine in (first, second):
        run(engine, bench.seconds, bench.dt)
    return {"bits": sum(a != b for a, b in zip(bits(first), bits(second), strict=True))}


def reorder(bench, scene):
    """How far any ball ends up from where it does when bodies are added in another order."""
    other, order = shuffled(scene)
    first, second = bench.build(scene), bench.build(other)
    for engine in (first, second):
        run(engine, bench.seconds, bench.dt)
    pairs = [(first.read(i), second.read(j)) for j, i in enumerate(order)]
    return {"shift": max(math.hypot(a.x - b.x, a.y - b.y) for a, b in pairs)}
