"""Cases of integrators, whose error depends on the step, and of pymunk."""

import math
from collections.abc import Sequence
from functools import partial

from grader.checks import exact
from grader.protocol import Rng
from grader.questions.numbers import Case, Draw, Maker, Unsuited, maker
from grader.questions.program import CannotAsk, Program
from grader.text import digits

OMEGA, X0 = 2 * math.pi, 100.0
ORDERS = {"semi_implicit_euler": 1, "velocity_verlet": 2, "rk4": 4}
CALLED = {
    "semi_implicit_euler": "semi-implicit Euler",
    "velocity_verlet": "velocity Verlet",
    "rk4": "RK4",
}


def measure_error(states: Sequence[tuple[float, float]], seconds: float) -> float:
    """Return the error of the spring's x at the end, px."""
    return abs(states[-1][0] - X0 * math.cos(OMEGA * seconds))


def own_error(program: Program, method: str, steps: int, seconds: float) -> float:
    with program.own.lab("integrators") as lab:
        force = (0.0, -(OMEGA**2))
        return measure_error(
            lab.integrate(method, (X0, 0.0), seconds / steps, force, steps), seconds
        )


def compute_error(method: str, steps: int, seconds: float) -> float:
    """Compute that error from the closed form of one step."""
    step, state = getattr(exact, method), (X0, 0.0)
    for _ in range(steps):
        state = step(*state, seconds / steps, lambda x: -(OMEGA**2) * x)
    return measure_error([state], seconds)


def make_halving_case(method: str, program: Program, draw: Draw) -> Case:
    """Make the case: the error of a method with half the step."""
    order, per_second, quarters = ORDERS[method], draw["per_second"], draw["quarters"]
    seconds = quarters / 4
    count = round(per_second * seconds)
    before, after = (compute_error(method, many, seconds) for many in (count, 2 * count))
    ratio = before / after
    if count != per_second * seconds or not 0.95 < ratio / 2**order < 1.05:
        raise Unsuited
    if not math.isclose(own_error(program, method, count, seconds), before, rel_tol=1e-6):
        raise CannotAsk("closed form and their program differ in the error with the whole step")
    return Case(
        f"Your {CALLED[method]} follows the spring of `integrators.py` for {seconds:g} s in "
        f"steps of 1/{per_second} s, and is {digits(float(f'{before:.4g}'))} px off in the end.\n"
        f"How far is it off with steps of 1/{2 * per_second} s?",
        after,
        own_error(program, method, 2 * count, seconds),
        "px",
        f"It is a method of order {order}: half the step divides the error by {2**order}.",
        [
            (before, "left the error as it is"),
            *(
                (before / 2**other, f"divided by {2**other}, as for order {other}")
                for other in (1, 2, 3, 4)
                if other != order
            ),
        ],
        share=0.08,
    )


def halving(name: str, todo: str, method: str, per_second: range) -> Maker:
    draws = {"per_second": per_second, "quarters": range(5, 40, 2)}
    return Maker(name, (todo,), draws, partial(make_halving_case, method), 5)


HALVINGS = (
    halving("verlet", "8b", "velocity_verlet", range(40, 121, 4)),
    halving("rk4", "8c", "rk4", range(16, 41, 4)),  # coarser: else the error is too small
    halving("semi-implicit", "8a", "semi_implicit_euler", range(40, 121, 4)),
)


@maker(5, "7b", scene=range(100, 1000))
def moment(program: Program, draw: Draw) -> Case:
    """Predict the moment of inertia of a ball in pymunk."""
    with program.own.lab("pymunk_scene") as lab:
        space = lab.thing(lab.call("empty_space"))
        lab.call("add_ball", space, Rng(draw["scene"]), (100.0, 100.0))
        bodies = [each for each in lab.space(lab.get(space, "")).bodies if each.kind == "dynamic"]
        lab.want(len(bodies) == 1, "one ball", f"{len(bodies)}")
        mass, radius, measured = bodies[0].mass, bodies[0].shapes[0].radius, bodies[0].moment
    if measured is None:
        raise CannotAsk("their ball has no moment")
    return Case(
        f"`add_ball(space, random.Random({draw['scene']}), (100, 100))` of your pymunk scene makes "
        f"a ball of {digits(mass)} kg with a radius of {radius:g} px.\nHow large is its moment?",
        exact.disc_moment(mass, radius),
        measured,
        "kg px²",
        "A full disc turns about its centre with ½ m r².",
        [
            (mass * radius**2, "took the moment of a ring, whose mass is all at the rim"),
            (0.4 * mass * radius**2, "took that of a full ball in space: here it is a disc"),
            (0.5 * mass * radius, "left the square out"),
        ],
    )


MAKERS = (*HALVINGS, moment)
