"""Cases of the lab scene: contacts, friction, the rod."""

import math

from grader.checks import exact
from grader.judge.lab import STEP
from grader.questions.numbers import Case, Draw, maker
from grader.questions.program import CannotAsk, Program
from grader.questions.scene import BOB, SEEDS, Scene
from grader.text import digits

LEDGE, LEDGE_TOP = (200.0, 260.0), 250.0
FLOOR, FLOOR_TOP = (450.0, 580.0), 560.0
DEPTH = 0.25  # px, less than SLOP: nothing is pushed out


@maker(1, "1 2", scene=SEEDS, ball=range(1, 9), speed=range(120, 480))
def impulse(program: Program, draw: Draw) -> Case:
    """Predict the normal impulse of a ball that lands on the ledge."""
    with program.own.lab("mini_engine") as lab:
        scene = Scene(lab, draw["scene"])
        (ball, state), (ledge, _) = scene.find_ball(draw["ball"]), scene.find_box(LEDGE)
        bounces = scene.read_number(ball, "restitution"), scene.read_number(ledge, "restitution")
        mass, speed = 1 / state.inv_mass, float(draw["speed"])
        lab.put(ball, pos=(200.0, LEDGE_TOP - state.radius + DEPTH), vel=(0.0, speed))
        contact = lab.thing(lab.call("collide", ball, ledge), "a Contact")
        lab.put(contact, target=lab.number(lab.call("target_speed", contact, STEP), "the target"))
        lab.call("solve_normal", contact)
        measured = scene.read_number(contact, "jn")
    own, bounce = bounces[0], min(bounces)
    return Case(
        f"{scene.intro} Ball {draw['ball']} of it has {digits(mass)} kg and a restitution of "
        f"{own:g}, the ledge one of {bounces[1]:g}. The ball falls straight down on the middle of "
        f"the ledge. When the first pass begins it has {speed:g} px/s, no spin, and is {DEPTH} px "
        "deep.\n"
        "How large is `jn` of this contact after the first pass of `solve_normal`?",
        mass * (1 + bounce) * speed,
        measured,
        "kg px/s",
        f"The pass brings the speed of {speed:g} px/s down to 0 and up to "
        f"{bounce:g} · {speed:g} px/s again: m (1 + e) v, with the smaller restitution.",
        [
            (mass * (1 + own) * speed, "took the ball's restitution: the smaller of two counts"),
            (mass * speed, "stopped the ball and forgot that it bounces"),
            (mass * bounce * speed, "took the speed after the bounce for the change of speed"),
            ((1 + bounce) * speed, "gave the change of speed: an impulse has the mass in it"),
        ],
    )


@maker(2, "2 4", scene=SEEDS, ball=range(1, 9), speed=range(150, 450), share=range(25, 75))
def friction(program: Program, draw: Draw) -> Case:
    """Predict the friction impulse of a ball that slides on the floor, at its limit."""
    with program.own.lab("mini_engine") as lab:
        scene = Scene(lab, draw["scene"])
        (ball, state), (floor, _) = scene.find_ball(draw["ball"]), scene.find_box(FLOOR)
        rough = math.sqrt(
            scene.read_number(ball, "friction") * scene.read_number(floor, "friction")
        )
        mass, speed = 1 / state.inv_mass, float(draw["speed"])
        pressed = float(round(draw["share"] / 100 * mass * speed / 3 / rough))
        lab.put(ball, pos=(450.0, FLOOR_TOP - state.radius + DEPTH), vel=(speed, 0.0))
        contact = lab.thing(lab.call("collide", ball, floor), "a Contact")
        lab.put(contact, jn=pressed)
        lab.call("solve_friction", contact)
        measured = abs(scene.read_number(contact, "jt"))
    return Case(
        f"{scene.intro} Ball {draw['ball']} of it has {digits(mass)} kg. It slides over the "
        f"floor at {speed:g} px/s and does not spin yet; both have a friction of {rough:g}. After "
        f"the normal impulse `jn` of the contact is {pressed:g} kg px/s.\n"
        "How large is `jt`, without its sign, after the first pass of `solve_friction`?",
        rough * pressed,
        measured,
        "kg px/s",
        f"To stop the slip would take m v / 3 = {digits(mass * speed / 3)} kg px/s, since friction "
        f"turns the ball as well. Coulomb's law allows {rough:g} · {pressed:g}.",
        [
            (mass * speed / 3, "stopped the slip and forgot the limit"),
            (mass * speed, "stopped the slip of a ball that cannot turn, without a limit"),
            (pressed, "took the whole normal impulse for the limit, without the friction"),
            (rough * rough * pressed, "multiplied the two frictions without the root"),
        ],
    )


@maker(1, "3", scene=SEEDS, tenths=range(6, 60))
def rod(program: Program, draw: Draw) -> Case:
    """Predict the speed that one pass gives the bob when its rod is too long."""
    long = draw["tenths"] / 10
    with program.own.lab("mini_engine") as lab:
        scene = Scene(lab, draw["scene"])
        joints = lab.items(lab.get(scene.world, "joints"), "the joints of the scene")
        lab.want(len(joints) == 1, "one rod", f"{len(joints)}")
        joint = lab.thing(joints[0])
        length = scene.read_number(joint, "length")
        bob = next((each for each, state in scene.bodies if state.radius == BOB), None)
        if bob is None:
            raise CannotAsk("the scene has no bob")
        lab.put(bob, pos=(700.0 + length + long, 90.0))
        lab.tell(joint, "prepare", STEP)
        lab.tell(joint, "solve")
        speed = math.hypot(*lab.state(bob).vel)
    answer = exact.BETA / STEP * long
    return Case(
        f"The rod of your lab scene is {long:g} px too long when a step of 1/120 s begins. The "
        "hook and the bob of 6 kg are at rest.\n"
        "With which speed does the bob move towards the hook after one pass of `solve`?",
        answer,
        speed,
        "px/s",
        f"A pass brings the speed to the bias, BETA / dt · error = 0.2 · 120 · {long:g} px/s. The "
        "hook is static and takes no part in it.",
        [
            (answer / exact.BETA, "took the whole error away in one step: BETA is missing"),
            (exact.BETA * long, "gave the way in this step: a speed is that divided by dt"),
            (answer / 2, "shared the speed with the hook, whose inverse mass is 0"),
            (answer * 6, "gave an impulse: it is divided by k, and so by the mass again"),
        ],
    )


MAKERS = (impulse, rod, friction)
