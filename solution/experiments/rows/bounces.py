"""Rows about bouncing: Newton's law of restitution, for one ball and still surfaces."""

import math
from functools import partial

from ..measures import energy_height, watch
from ..scenes import BOUNCE, DT, Ball, Block, G, Scene, drop, floor
from .rest import late_speed
from .row import ENERGY, STILL, Bound, H, Row, fall_speed, law, run_for, velocity_off_after

LEAVES = "A ball that lands at speed v leaves at e v, and its flight keeps its energy."


def rise_after_bounce(trial, scene):
    """Run until the ball rises after its first bounce. Return its state and the height of its apex.

    Heights are those of the lowest point of the ball above the floor.
    """
    engine, radius, hit = trial.build(scene), scene.bodies[1].radius, False
    state, apex = None, 0.0
    for _ in range(round(10 / DT)):
        before = engine.read(1).vy
        engine.step(DT)
        now = engine.read(1)
        if hit and now.vy >= 0:
            break
        if before > 0 > now.vy or hit:
            hit, state, apex = True, now, energy_height(engine, 1, DT)
    if state is None:
        return engine.read(1), 0.0
    return state, apex - state.vx**2 / (2 * G) - radius


def first_rebound(trial, scene, height, e):
    """Return the error (px/s) of the speed after the first bounce."""
    _, apex = rise_after_bounce(trial, scene)
    return abs(fall_speed(max(apex, 0)) - e * fall_speed(height))


def last_apex(trial, scene, seconds, height):
    """Return the error of the apex of the last two seconds, as a share of the first apex."""
    engine, radius = run_for(trial, scene, seconds - 2), scene.bodies[1].radius
    tops = watch(engine, 2, lambda: energy_height(engine, 1) - radius)
    return abs(sorted(tops)[len(tops) // 2] / height - 1)


def keeps_sideways(trial, scene):
    """Return the speed along the floor that a bounce without friction takes."""
    state, _ = rise_after_bounce(trial, scene)
    return abs(state.vx - scene.bodies[1].vel[0])


def rough(trial, scene, vx, omega):
    """Return the error (px/s) of the speeds along the floor and at the rim."""
    state, _ = rise_after_bounce(trial, scene)
    return max(abs(state.vx - vx), 10 * abs(state.omega - omega))


def rough_drop(vx, omega, mu, e, height=290.0):
    ball = Ball((0, -10 - height), 10, 1.0, (vx, 0.0), omega, e, mu)
    return Scene([floor(restitution=e, friction=mu), ball], BOUNCE)


def rough_exact(vx, omega, mu, e, height=290.0):
    """Return speed and spin after a rough bounce: Coulomb's impulse stops the rim, or slips."""
    slip = vx - 10 * omega
    grip = min(mu * (1 + e) * fall_speed(height), abs(slip) / 3)
    impulse = math.copysign(grip, slip)
    return vx - impulse, omega + 2 * impulse / 10


def corner(vel, gap):
    """Make a ball that flies into the corner of a floor and a wall; no gravity, no friction."""
    walls = [Block((0, 50), (500, 50), 1.0, 0), Block((50, -200), (50, 300), 1.0, 0)]
    pos = (-10 - vel[0] / 2 - gap, -10 - vel[1] / 2)
    ball = Ball(pos, 10, 1.0, vel, restitution=1.0, friction=0)
    return Scene([*walls, ball], ("Contacts", "Bounce"), gravity=(0, 0))


def between_walls(fast, half=50, effects=("Contacts", "Bounce")):
    """Make a ball that flies to and fro between two walls 200 px apart, of this half width."""
    walls = [Block((x, 0), (half, 50), 1.0, 0) for x in (-100 - half, 100 + half)]
    ball = Ball((0, 0), 10, 1.0, (fast, 0), restitution=1.0, friction=0, bullet=True)
    return Scene([*walls, ball], effects, gravity=(0, 0))


def keeps_flying(trial, scene, seconds=5):
    """Return the error (px/s) of the speed; a ball that has escaped is off by all of it."""
    state, fast = run_for(trial, scene, seconds).read(2), scene.bodies[2].vel[0]
    return abs(abs(state.vx) - fast) if abs(state.x) < 100 else fast


def unfolded(trial, scene, seconds=2):
    """Return the distance (px) of the ball from its exact flight to and fro."""
    state, fast = run_for(trial, scene, seconds).read(2), scene.bodies[2].vel[0]
    along = (fast * seconds + 90) % 360
    return abs(state.x - (along - 90 if along < 180 else 270 - along))


# fmt: off
def make_rows():
    gentle = "the speed at the floor is known to the gravity of one substep"
    for e in (0.1, 0.3, 0.5, 0.7, 0.9, 1.0):
        yield Row(f"bounce: first rebound, e = {e}", LEAVES, partial(drop, 290.0, e),
                  partial(first_rebound, height=290.0, e=e), Bound((1 + e) * G * H, gentle),
                  quick=e == 0.5)
    for height in (5.0, 50.0, 2000.0):
        for e in (0.5, 1.0):
            yield Row(f"bounce: from {height:g} px, e = {e}", LEAVES, partial(drop, height, e),
                      partial(first_rebound, height=height, e=e), Bound((1 + e) * G * H, gentle))
    for height in (20.0, 290.0):
        yield Row(f"bounce: e = 1 for 30 s, from {height:g} px",
                  "With e = 1 nothing takes energy: each apex is as high as the first.",
                  partial(drop, height, 1.0), partial(last_apex, seconds=30, height=height),
                  ENERGY, quick=height == 290)
    for e in (0.5, 0.8):
        total = fall_speed(290) / G * (1 + e) / (1 - e)
        yield Row(f"bounce: e = {e} comes to rest", "The times of all bounces add up to "
                  "√(2h/g) (1 + e) / (1 - e): half a second later the ball rests.",
                  partial(drop, 290.0, e), partial(late_speed, seconds=total + 1.5), STILL)
    for e in (0.5, 1.0):
        yield Row(f"bounce: without friction at 300 px/s, e = {e}",
                  "Without friction nothing acts along the floor.",
                  partial(rough_drop, 300.0, 0.0, 0.0, e), keeps_sideways, law(300))
    for vx, omega, mu, e in ((300.0, 0.0, 0.1, 0.5), (300.0, 0.0, 0.6, 0.5), (300.0, 0.0, 1.0, 1.0),
                             (0.0, 50.0, 0.6, 0.5), (0.0, 200.0, 0.2, 0.8),
                             (-200.0, 60.0, 0.6, 1.0), (900.0, 0.0, 0.3, 0.3)):
        after = rough_exact(vx, omega, mu, e)
        yield Row(f"bounce: rough, {vx:g} px/s, spin {omega:g}/s, μ {mu}, e {e}",
                  "Coulomb: the impulse along the floor stops the rim, or is μ times the other.",
                  partial(rough_drop, vx, omega, mu, e),
                  partial(rough, vx=after[0], omega=after[1]), Bound(3 * (1 + e) * G * H, gentle),
                  quick=mu == 0.1)
    for degrees in (30, 45, 60):
        way = math.radians(degrees)
        vx, vy = 400 * math.cos(way), 400 * math.sin(way)
        for gap in (0.0, 7.0):
            yield Row(f"bounce: into a corner at {degrees}°, {gap:g} px off the middle",
                      "Wall and floor each reverse one part of the velocity: it comes back.",
                      partial(corner, (vx, vy), gap),
                      partial(velocity_off_after, exact=(-vx, -vy), seconds=1, i=2), law(400),
                      quick=degrees == 45)
    for fast in (300.0, 3000.0):
        walls = partial(between_walls, fast)
        yield Row(f"bounce: between two walls at {fast:g} px/s, speed",
                  "With e = 1 the speed stays.", walls, keeps_flying, law(fast))
        count = math.ceil(2 * fast / 180)
        yield Row(f"bounce: between two walls at {fast:g} px/s, place",
                  "Its path is a straight one, folded.", walls, unfolded,
                  Bound(count * fast * H, "one substep of motion at each wall"))
