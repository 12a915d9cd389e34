"""TODO B1: update_sleep. Bodies at rest sleep after half a second, and wake when disturbed.

Whether each body sleeps by itself or a whole pile at once is left open: scenes are clearly at rest
or clearly not.
"""

import math

from grader.judge.lab import STEP, Lab, Pair, Thing

GRAVITY = 980.0  # px/s²
RADIUS = 10.0  # px
LYING = -RADIUS + 0.25  # px, the centre of a ball that lies on a floor whose top is at 0

# When a body is looked at. Known mistakes are told by what is seen then: see mistakes_b1.py.
AT_FIRST, AT_REST = "for the first half second", "after 0.75 s at rest"
FLYING, ROLLING, SPINNING = "in free flight", "while it rolls", "while it spins"
ON_A_ROD = "on its rod"
AFTER_A_PUSH = "for half a second after the push, as its time begins anew"
AFTER_A_HIT = "after the hit"
FLOOR_GONE, CARRIED_AWAY = "when its floor is gone", "when the ball below is gone"
CHEAP = "a pile that sleeps costs next to nothing"


def floor(lab: Lab, friction: float = 0.6) -> Thing:
    return lab.box((0.0, 50.0), (500.0, 50.0), friction=friction)


def ball(
    lab: Lab, x: float = 0.0, y: float = LYING, vel: Pair = (0.0, 0.0), omega: float = 0.0
) -> Thing:
    return lab.circle((x, y), RADIUS, vel=vel, omega=omega, friction=0.6, restitution=0.0)


def room(
    lab: Lab, *bodies: Thing, gravity: float = GRAVITY, joints: tuple[Thing, ...] = ()
) -> Thing:
    """A world in which bodies may sleep."""
    world = lab.world(*bodies, gravity=(0.0, gravity), joints=joints, bonus=True)
    lab.put(world, sleeping=True)
    return world


def asleep(lab: Lab, body: Thing) -> bool:
    value = lab.get(body, "asleep")
    lab.want(isinstance(value, bool), "True or False as Body.asleep", lab.describe(value))
    return bool(value)


def want(lab: Lab, sleeps: bool, body: Thing, when: str) -> None:
    words = ("awake", "asleep")
    found = asleep(lab, body)
    lab.saw("sleep", (when,), found)
    lab.want(found == sleeps, f"{words[sleeps]} {when}", words[found])


def run(lab: Lab, world: Thing, seconds: float) -> None:
    lab.simulate(world, [], round(seconds / STEP))


def put_to_sleep(lab: Lab, world: Thing, *bodies: Thing) -> None:
    run(lab, world, 0.75)
    for body in bodies:
        want(lab, True, body, AT_REST)


def a_ball_at_rest_sleeps_after_half_a_second(lab: Lab) -> None:
    """A ball at rest sleeps after half a second, and then stays where it is"""
    lab.ran("a ball that lies on the floor")
    lying, ground = ball(lab), floor(lab)
    world = room(lab, ground, lying)
    run(lab, world, 0.45)
    want(lab, False, lying, AT_FIRST)
    run(lab, world, 0.3)
    want(lab, True, lying, AT_REST)
    lab.want(not asleep(lab, ground), "a floor that is static and never asleep", "a floor asleep")
    before = lab.state(lying)
    run(lab, world, 0.5)
    after = lab.state(lying)
    lab.want(
        (after.pos, after.angle) == (before.pos, before.angle),
        "a sleeper exactly where it fell asleep half a second ago",
        f"it moved by {math.dist(tuple(before.pos), tuple(after.pos)):.3g} px",
    )


def nothing_sleeps_that_moves_flies_or_hangs(lab: Lab) -> None:
    """Nothing sleeps that rolls, spins, flies or is held, and each push begins anew"""
    lab.ran("a ball thrown up at 20 px/s where things fall at 20 px/s²: slow for 1.2 s at the top")
    thrown = ball(lab, vel=(0.0, -20.0))
    stay_awake(lab, room(lab, thrown, gravity=20.0), thrown, FLYING)
    lab.ran("a ball that rolls over the floor at 60 px/s")
    rolling = ball(lab, vel=(60.0, 0.0), omega=60.0 / RADIUS)
    stay_awake(lab, room(lab, floor(lab), rolling), rolling, ROLLING)
    lab.ran("a ball that spins on ice at 20 rad/s, and does not move along")
    spinning = ball(lab, omega=20.0)
    stay_awake(lab, room(lab, floor(lab, 0.0), spinning), spinning, SPINNING)
    lab.ran("a ball that lies on the floor and is held by a rod")
    hook, held = lab.circle((0.0, -150.0), 5.0, 0.0), ball(lab)
    rod = lab.thing(lab.call("DistanceJoint", hook, held), "a DistanceJoint")
    stay_awake(lab, room(lab, floor(lab), hook, held, joints=(rod,)), held, ON_A_ROD)
    lab.ran("a ball that lies for 0.4 s, is pushed at 100 px/s for 0.1 s and lies again for 0.4 s")
    pushed = ball(lab)
    world = room(lab, floor(lab), pushed)
    run(lab, world, 0.4)
    lab.put(pushed, vel=(100.0, 0.0))
    run(lab, world, 0.1)
    lab.put(pushed, vel=(0.0, 0.0), omega=0.0)
    run(lab, world, 0.4)
    want(lab, False, pushed, AFTER_A_PUSH)


def stay_awake(lab: Lab, world: Thing, body: Thing, why: str) -> None:
    for _ in range(4):
        run(lab, world, 0.25)
        if asleep(lab, body):
            break
    want(lab, False, body, why)


def a_sleeper_wakes_when_it_is_hit_or_loses_its_support(lab: Lab) -> None:
    """A sleeper wakes when a moving body hits it, and when what it lies on goes away"""
    lab.ran("a ball that rolls at 200 px/s into one that sleeps")
    sleeper, ground = ball(lab), floor(lab)
    world = room(lab, ground, sleeper)
    put_to_sleep(lab, world, sleeper)
    lab.tell(world, "add", ball(lab, -60.0, vel=(200.0, 0.0), omega=20.0))
    run(lab, world, 0.3)
    want(lab, False, sleeper, AFTER_A_HIT)
    # Of two equal balls that do not bounce each goes on at half the speed.
    speed = lab.state(sleeper).vel.x
    lab.want(speed > 50.0, "it rolls on at about 100 px/s", f"{speed:.1f} px/s")
    lab.ran("a ball that sleeps on a floor, and the floor is taken out of the world")
    sleeper, ground = ball(lab), floor(lab)
    world = room(lab, ground, sleeper)
    put_to_sleep(lab, world, sleeper)
    lab.tell(world, "bodies.remove", ground)
    want_a_fall(lab, world, sleeper, FLOOR_GONE)
    lab.ran("a ball that sleeps on another one, which wakes and is carried away")
    lower, upper = ball(lab), ball(lab, y=LYING - 2 * RADIUS + 0.25)
    world = room(lab, floor(lab), lower, upper)
    put_to_sleep(lab, world, lower, upper)
    lab.call("wake", lower)
    lab.put(lower, pos=(300.0, LYING))
    want_a_fall(lab, world, upper, CARRIED_AWAY)


def want_a_fall(lab: Lab, world: Thing, body: Thing, when: str) -> None:
    """It must fall for 0.15 s as all things do, by g t² / 2, or 11 px."""
    before = lab.state(body).pos.y
    run(lab, world, 0.15)
    fallen = lab.state(body).pos.y - before
    lab.saw("sleep", (when,), fallen <= 5.0)
    lab.want(fallen > 5.0, "it wakes and falls 11 px in 0.15 s", f"{fallen:.1f} px")


def a_sleeping_pile_costs_next_to_nothing(lab: Lab) -> None:
    """A pile that sleeps costs next to nothing"""
    lab.ran("five balls that lie in two rows between walls")
    walls = [lab.box((x, -100.0), (20.0, 150.0), friction=0.6) for x in (-20.0, 6 * RADIUS + 20.0)]
    low = [ball(lab, RADIUS * (1 + 2 * number)) for number in range(3)]
    high = [
        ball(lab, RADIUS * (2 + 2 * number), LYING - math.sqrt(3) * RADIUS) for number in range(2)
    ]
    world = room(lab, floor(lab), *walls, *low, *high)
    work = ("collide", "World.solve_contact")
    awake = lab.count(work, world, "step", STEP)
    put_to_sleep(lab, world, *low, *high)
    sleeping = lab.count(work, world, "step", STEP)
    lab.saw("sleep", (CHEAP,), 10 * sleeping <= awake)
    lab.want(
        10 * sleeping <= awake,
        f"at most a tenth of the {awake} calls of collide and solve_contact that it took awake",
        f"{sleeping} calls a step",
    )
