"""TODO B1: update_sleep. Bodies at rest sleep after half a second, and wake when disturbed.

Bodies may sleep one by one or as a whole pile: scenes are clearly at rest or clearly not.
"""

import math

from grader.judge.lab import STEP, Lab, Pair, Thing
from grader.protocol import BodyValue, Rng, Value

GRAVITY = 980.0  # px/s²
RADIUS = 10.0  # px
LYING = -RADIUS + 0.25  # px, the centre of a ball that lies on a floor whose top is at 0

# Moments at which a body is observed, to recognise known mistakes: see mistakes.py.
AT_FIRST, AT_REST = "for the first half second", "after 0.75 s at rest"
LONG_AT_REST = "when its timer is at 0.6 s"
CREEPING = "after 0.75 s at 3 px/s"
FLYING, ROLLING, SPINNING = "in free flight", "while it rolls", "while it spins"
ON_A_ROD, ON_A_SPRING = "on its rod", "on its spring"
AFTER_A_PUSH = "for half a second after the push, as its time begins anew"
AFTER_THE_AIR = "for half a second after it came down, as its time begins anew"
AFTER_A_HIT, AFTER_A_SPIN = "after the hit", "when a ball that spins has touched it"
ANOTHER_HIT = "when another one is hit, far away"
FLOOR_GONE, CARRIED_AWAY = "when its floor is gone", "when the ball below is gone"
ONE_OF_TWO_GONE = "when one of the two boxes it lies on is gone"
IN_TURN = "after its neighbours have come to rest one after another, and 3 s"
STATIC = "as a floor that is static"
CHEAP = "a sleeping pile costs almost no time"

STEPS = (1 / 60, 1 / 120, 1 / 165, 1 / 480)  # s, steps in which gravity adds 2 to 16 px/s
LESS = 10  # times as much work awake
LAB_SCENE = 40.0  # s; a ball that rolls at 20 px/s still has 3 px/s then, as it loses 5 % a second
FALLING_ASLEEP = "vel omega inv_mass inv_inertia"  # fields that may change at that moment


def floor(lab: Lab, friction: float = 0.6) -> Thing:
    return lab.box((0.0, 50.0), (500.0, 50.0), friction=friction)


def ball(
    lab: Lab,
    x: float = 0.3,
    y: float = LYING,
    vel: Pair = (0.0, 0.0),
    omega: float = 0.0,
    mass: float = 1.0,
    angle: float = 0.0,
    friction: float = 0.6,
    restitution: float = 0.0,
) -> Thing:
    fields = {"vel": vel, "omega": omega, "angle": angle}
    surface = {"friction": friction, "restitution": restitution}
    return lab.circle((x, y), RADIUS, lab.factor * mass, **surface, **fields)


def room(
    lab: Lab, *bodies: Thing, gravity: float = GRAVITY, joints: tuple[Thing, ...] = ()
) -> Thing:
    """Return a world in which bodies may sleep."""
    world = lab.world(*bodies, gravity=(0.0, gravity), joints=joints, bonus=True)
    lab.put(world, sleeping=True)
    return world


def is_asleep(lab: Lab, body: Thing) -> bool:
    return as_bool(lab, lab.get(body, "asleep"))


def as_bool(lab: Lab, value: Value) -> bool:
    lab.want(isinstance(value, bool), "True or False as Body.asleep", lab.describe(value))
    return bool(value)


def want(lab: Lab, sleeps: bool, body: Thing, when: str) -> None:
    words = ("awake", "asleep")

    def judge(value: Value) -> None:
        found = as_bool(lab, value)
        lab.saw("sleep", (when,), found)
        lab.want(found == sleeps, f"{words[sleeps]} {when}", words[found])

    lab.get(body, "asleep", then=judge)


def run(lab: Lab, world: Thing, seconds: float, dt: float = STEP) -> None:
    steps = round(seconds / dt)
    lab.simulate(world, [], steps, dt, every=steps)


def put_to_sleep(lab: Lab, world: Thing, *bodies: Thing) -> None:
    run(lab, world, lab.about(0.75, 0.125))
    for body in bodies:
        want(lab, True, body, AT_REST)


def a_ball_at_rest_sleeps_after_half_a_second(lab: Lab) -> None:
    """A ball at rest sleeps after half a second, and then stays where it is"""
    for dt in STEPS:
        lab.ran(f"a ball that lies on the floor, in steps of 1/{round(1 / dt)} s")
        lying, ground = ball(lab), floor(lab)
        world = room(lab, ground, lying)
        start = lab.state(lying)
        run(lab, world, lab.about(0.45, 0.04), dt)
        want(lab, False, lying, AT_FIRST)
        run(lab, world, lab.about(0.3, 0.05), dt)
        want(lab, True, lying, AT_REST)
        static = not is_asleep(lab, ground)
        lab.saw("sleep", (STATIC,), not static)
        lab.want(static, "a floor that is static and never asleep", "a floor asleep")
        before = lab.state(lying)
        lab.want(
            math.dist(start.pos, before.pos) < 0.1,  # px: it sinks in by less than the rest of SLOP
            "a ball that fell asleep where it lay",
            f"it moved by {math.dist(start.pos, before.pos):.3g} px",
        )
        run(lab, world, lab.about(0.5), dt)
        want_still(lab, before, lab.state(lying))
    lab.ran("a ball that creeps over the floor at 3 px/s")
    creeping = ball(lab, vel=(3.0, 0.0), omega=3.0 / RADIUS)
    world = room(lab, floor(lab), creeping)
    run(lab, world, lab.about(0.75, 0.125))
    want(lab, True, creeping, CREEPING)
    lab.ran("a ball of 0.05 kg and one of 300 kg that lie on the floor")
    light, heavy = ball(lab, mass=0.05), ball(lab, 60.0, mass=300.0)
    put_to_sleep(lab, room(lab, floor(lab), light, heavy), light, heavy)
    lab.ran(
        "24 balls that lie on a floor, from left of the window to right of it, smooth and rough"
    )
    ground = lab.box((900.0, 50.0), (1900.0, 50.0), friction=0.6)
    balls = [
        ball(lab, 130.0 * number - 700.0, friction=0.6 * (number % 3), restitution=number % 2)
        for number in range(24)
    ]
    put_to_sleep(lab, room(lab, ground, *balls), *balls)
    the_lab_scene_falls_asleep(lab)


def want_still(lab: Lab, before: BodyValue, after: BodyValue) -> None:
    lab.want(
        (after.pos, after.angle) == (before.pos, before.angle),
        "a sleeper exactly where it fell asleep half a second ago",
        f"it moved by {math.dist(before.pos, after.pos):.3g} px",
    )


def the_lab_scene_falls_asleep(lab: Lab) -> None:
    """Insist that all balls turn grey, except the pendulum's bob on its rod."""
    lab.ran(f"the lab scene with S on, for {LAB_SCENE:g} s")
    made = lab.thing(lab.call("make_world", Rng(46)), "a World")
    bodies = [lab.thing(each) for each in lab.items(lab.get(made, "bodies"), "World.bodies")]
    rods = [lab.thing(each) for each in lab.items(lab.get(made, "joints"), "World.joints")]
    world = lab.world(
        *bodies,
        gravity=(0.0, GRAVITY),
        linear_damping=0.05,
        angular_damping=0.3,
        joints=rods,
        bonus=True,
    )
    lab.put(world, sleeping=True)
    states = map(lab.body, lab.gets((each, "") for each in bodies))
    balls = [Thing(each.ref) for each in states if each.inv_mass][1:]  # the first one is the bob
    left = len(balls)
    for second in range(round(LAB_SCENE)):
        run(lab, world, 1.0)
        asleep = lab.gets((each, "asleep") for each in balls)
        left = sum(not as_bool(lab, each) for each in asleep)
        if not left or (second > LAB_SCENE / 8 and left == len(balls)):
            break
    lab.want(not left, f"all its {len(balls)} balls asleep", f"{left} awake")


def nothing_sleeps_that_moves_flies_or_hangs(lab: Lab) -> None:
    """Bodies that roll, spin, fly or are held stay awake; a push restarts the time"""
    nothing_sleeps_that_moves_or_flies(lab)
    nothing_sleeps_that_is_held(lab)
    time_at_rest_begins_anew(lab)


def nothing_sleeps_that_moves_or_flies(lab: Lab) -> None:
    lab.ran("a ball that lies on the floor")  # first: a body that was slow may move again
    lying = ball(lab)
    put_to_sleep(lab, room(lab, floor(lab), lying), lying)
    lab.ran("a ball thrown up at 20 px/s where things fall at 20 px/s²: slow for 1.2 s at the top")
    thrown = ball(lab, vel=(0.0, -20.0))
    stay_awake(lab, room(lab, thrown, gravity=20.0), thrown, FLYING)
    lab.ran("a ball that rolls over the floor at 60 px/s")
    rolling = ball(lab, vel=(60.0, 0.0), omega=60.0 / RADIUS)
    stay_awake(lab, room(lab, floor(lab), rolling), rolling, ROLLING)
    lab.ran("a ball that spins on ice at 20 rad/s, and does not move along")
    spinning = ball(lab, omega=20.0)
    stay_awake(lab, room(lab, floor(lab, 0.0), spinning), spinning, SPINNING)
    lab.ran("a ball that touches nothing and stands still, without gravity")
    floating = ball(lab, y=-100.0)
    stay_awake(lab, room(lab, floor(lab), floating, gravity=0.0), floating, FLYING)


def nothing_sleeps_that_is_held(lab: Lab) -> None:
    for first in (True, False):
        lab.ran("a ball that lies on the floor and is held by a rod")
        hook, held = lab.circle((0.3, -150.0), 5.0, 0.0), ball(lab)
        ends = (held, hook) if first else (hook, held)
        rod = lab.make("DistanceJoint", *ends)
        stay_awake(lab, room(lab, floor(lab), hook, held, joints=(rod,)), held, ON_A_ROD)
        lab.ran("a ball that lies on the floor and is held by a spring")
        hook, held = lab.circle((0.3, -150.0), 5.0, 0.0), ball(lab)
        ends = (held, hook) if first else (hook, held)
        spring = lab.make("SpringJoint", *ends, 0.1)
        world = room(lab, floor(lab), hook, held)
        lab.let(world, "springs.append", spring)
        stay_awake(lab, world, held, ON_A_SPRING)


def time_at_rest_begins_anew(lab: Lab) -> None:
    for vel, omega in (((1500.0, 0.0), 0.0), ((0.0, -300.0), 0.0), ((0.0, 0.0), 60.0)):
        lab.ran(
            f"a ball that lies for 0.4 s, is pushed to {vel} px/s and {omega:g} rad/s for 0.1 s "
            "and lies again for 0.4 s"
        )
        pushed = ball(lab)
        world = room(lab, floor(lab), pushed)
        run(lab, world, lab.about(0.4, 0.05))
        lab.put(pushed, vel=vel, omega=omega)
        run(lab, world, 0.1)
        x = lab.state(pushed).pos.x
        lab.put(pushed, pos=(x, LYING), vel=(0.0, 0.0), omega=0.0)
        run(lab, world, lab.about(0.4, 0.05))
        want(lab, False, pushed, AFTER_A_PUSH)
    lab.ran("a ball that touches the floor for 0.4 s, nothing for 0.1 s, and then the floor again")
    lifted = ball(lab)
    world = room(lab, floor(lab), lifted, gravity=0.0)
    for y, seconds in ((LYING, 0.4), (LYING - 50.0, 0.1), (LYING, 0.4)):
        lab.put(lifted, pos=(0.3, y))
        run(lab, world, lab.about(seconds, seconds / 8))
    want(lab, False, lifted, AFTER_THE_AIR)


def stay_awake(lab: Lab, world: Thing, body: Thing, why: str) -> None:
    for _ in range(4):
        run(lab, world, lab.about(0.25, 0.03))
        if is_asleep(lab, body):
            break
    want(lab, False, body, why)


def a_sleeper_wakes_when_it_is_hit_or_loses_its_support(lab: Lab) -> None:
    """A sleeper wakes when a moving body hits it, and when its support goes away"""
    a_hit_wakes(lab)
    what_comes_to_rest_in_turn_sleeps(lab)
    what_has_lost_its_support_falls(lab)
    going_to_sleep_changes_nothing_else(lab)


def what_comes_to_rest_in_turn_sleeps(lab: Lab) -> None:
    """Insist that a ball at rest, though awake, wakes no neighbour."""
    lab.ran("three balls that lie side by side; the second comes 0.3 s after the first, and so on")
    row = [ball(lab, 2 * RADIUS * number - 0.1 * number) for number in range(3)]
    world = room(lab, floor(lab), row[0])
    for late in row[1:]:
        run(lab, world, lab.about(0.3, 0.1))
        lab.let(world, "add", late)
    run(lab, world, 3.0)
    for each in row:
        want(lab, True, each, IN_TURN)


def a_hit_wakes(lab: Lab) -> None:
    lab.ran("a ball that rolls at 200 px/s into one that sleeps, and again when that sleeps anew")
    sleeper, another, ground = ball(lab), ball(lab, -400.0), floor(lab)
    world = room(lab, ground, sleeper, another)
    for _ in range(3):
        put_to_sleep(lab, world, sleeper, another)
        x = lab.state(sleeper).pos.x
        roller = ball(lab, x - 60.0, vel=(200.0, 0.0), omega=20.0)
        lab.let(world, "add", roller)
        run(lab, world, 0.3)
        want(lab, False, sleeper, AFTER_A_HIT)
        want(lab, True, another, ANOTHER_HIT)
        # Two equal balls that do not bounce both move on at half the speed.
        speed = lab.state(sleeper).vel.x
        lab.want(speed > 50.0, "it rolls on at about 100 px/s", f"{speed:.1f} px/s")
        lab.let(world, "bodies.remove", roller)
        lab.put(sleeper, vel=(0.0, 0.0), omega=0.0)
    lab.ran("a ball of 0.1 kg that falls at 300 px/s on one of 50 kg that sleeps")
    sleeper = ball(lab, mass=50.0)
    world = room(lab, floor(lab), sleeper)
    put_to_sleep(lab, world, sleeper)
    lab.let(world, "add", ball(lab, y=LYING - 60.0, vel=(0.0, 300.0), mass=0.1))
    woke = False
    for _ in range(30):
        run(lab, world, STEP)
        woke = woke or not is_asleep(lab, sleeper)
    lab.saw("sleep", (AFTER_A_HIT,), not woke)
    lab.want(woke, f"awake {AFTER_A_HIT}", "asleep")
    lab.want(
        abs(lab.state(sleeper).inv_mass * lab.factor * 50.0 - 1.0) < 1e-9
        or is_asleep(lab, sleeper),
        "a ball that has its 50 kg again",
        "another mass",
    )
    lab.ran("a ball that spins at 40 rad/s, put down so that it touches one that sleeps")
    sleeper = ball(lab)
    world = room(lab, floor(lab), sleeper)
    put_to_sleep(lab, world, sleeper)
    lab.let(world, "add", ball(lab, 0.3 + 2 * RADIUS - 0.2, omega=40.0))
    run(lab, world, STEP)
    want(lab, False, sleeper, AFTER_A_SPIN)
    lab.ran("a ball that rolls past one that sleeps, and touches it nowhere")
    sleeper = ball(lab)
    world = room(lab, floor(lab), sleeper, ball(lab, -60.0, -80.0, vel=(300.0, -100.0)))
    put_to_sleep(lab, world, sleeper)


def what_has_lost_its_support_falls(lab: Lab) -> None:
    lab.ran("a ball that sleeps on a floor, and the floor is taken out of the world")
    sleeper, ground = ball(lab, angle=1.0), floor(lab)
    world = room(lab, ground, sleeper)
    put_to_sleep(lab, world, sleeper)
    lab.let(world, "bodies.remove", ground)
    want_a_fall(lab, world, sleeper, FLOOR_GONE)
    angle = lab.state(sleeper).angle
    lab.want(abs(angle - 1.0) < 1e-6, "a ball still turned by 1 rad", f"by {angle:.6g} rad")
    for gone in range(2):
        lab.ran("a ball that sleeps in the gap between two boxes, and one of them is taken away")
        boxes = [lab.box((x, 50.0), (100.0, 50.0), friction=0.6) for x in (-105.7, 106.3)]
        sleeper = ball(lab, y=-7.9)
        world = room(lab, *boxes, sleeper)
        put_to_sleep(lab, world, sleeper)
        lab.let(world, "bodies.remove", boxes[gone])
        run(lab, world, STEP)
        want(lab, False, sleeper, ONE_OF_TWO_GONE)
    lab.ran("a ball that sleeps on another one, which wakes and is carried away")
    lower, upper = ball(lab), ball(lab, y=LYING - 2 * RADIUS + 0.25)
    world = room(lab, floor(lab), lower, upper)
    put_to_sleep(lab, world, lower, upper)
    lab.call("wake", lower)
    lab.put(lower, pos=(300.0, LYING))
    want_a_fall(lab, world, upper, CARRIED_AWAY)


def want_a_fall(lab: Lab, world: Thing, body: Thing, when: str) -> None:
    """Insist that it falls freely for 0.15 s, by g t² / 2, or 11 px."""
    before = lab.state(body).pos.y
    run(lab, world, 0.15)
    fallen = lab.state(body).pos.y - before
    lab.saw("sleep", (when,), fallen <= 5.0)
    lab.want(fallen > 5.0, "it wakes and falls 11 px in 0.15 s", f"{fallen:.1f} px")


def going_to_sleep_changes_nothing_else(lab: Lab) -> None:
    """Insist that update_sleep changes nothing that does not concern sleep."""
    lab.ran("update_sleep, for balls that have been at rest for 0, 0.3, 0.495 and 0.6 s")
    times = (0.0, 0.3, 0.495, 0.6, 0.6)  # s
    bodies = [ball(lab, 40.3 * number, angle=7.0) for number in range(len(times))]
    flying = ball(lab, y=-200.0, vel=(40.0, 30.0), omega=3.0, angle=-8.0)
    hook, bob = lab.circle((900.0, -300.0), 5.0, 0.0), ball(lab, 900.0, -100.0)
    more = ball(lab, 940.0, -100.0)
    ends = (hook, bob), (bob, more)
    rods = [lab.make("DistanceJoint", *each) for each in ends]
    world = room(lab, *bodies, floor(lab), flying, hook, bob, more, gravity=0.0, joints=(*rods,))
    for each in ends:
        lab.let(world, "springs.append", lab.make("SpringJoint", *each, 0.1))
    run(lab, world, STEP)  # so that it knows its contacts
    # Fields that only forces read, set when no force follows; no number is round.
    lab.put(world, linear_damping=0.515625, angular_damping=0.296875, grid=False)
    lab.put(world, gravity=(0.28125, 0.0))
    for body, seconds in zip(bodies, times, strict=True):
        lab.put(body, vel=(2.0, 0.0), omega=-0.1, still_for=seconds)
    looked_at = (*bodies, flying, hook, bob, more, *rods)
    for may in (bodies[2:], bodies[2:-2]):
        frame = dict.fromkeys(may, FALLING_ASLEEP)
        lab.call("update_sleep", world, STEP, changes=frame, sees=looked_at)
        want(lab, True, bodies[-1], LONG_AT_REST)
    lab.put(flying, pos=(40.3 * (len(times) - 1), LYING - 2 * RADIUS + 0.5))
    lab.tell(world, "step", STEP)
    frame = dict.fromkeys(bodies[2:], FALLING_ASLEEP)
    lab.call("update_sleep", world, STEP, changes=frame, sees=looked_at)


def a_sleeping_pile_costs_next_to_nothing(lab: Lab) -> None:
    """A sleeping pile costs almost no time"""
    rows = ((3, 1), (2, 2))  # number of balls, and radii from the wall to the first
    lab.ran("five balls that lie in two rows between walls")
    walls = [lab.box((x, -100.0), (20.0, 150.0), friction=0.6) for x in (-20.0, 6 * RADIUS + 20.0)]
    balls = [
        ball(lab, RADIUS * (first + 2 * number), LYING - math.sqrt(3) * RADIUS * row)
        for row, (count, first) in enumerate(rows)
        for number in range(count)
    ]
    world = room(lab, floor(lab), *walls, *balls)
    lab.put(world, sleeping=False)
    run(lab, world, 0.2)  # until they touch
    awake = lab.work(world, "step", STEP)
    lab.put(world, sleeping=True)
    put_to_sleep(lab, world, *balls)
    sleeping = lab.work(world, "step", STEP)
    lab.saw("sleep", (CHEAP,), LESS * sleeping <= awake)
    lab.want(
        LESS * sleeping <= awake,
        f"at most one line of your code for each {LESS} of the {awake} that a step took awake",
        f"{sleeping} lines",
    )
