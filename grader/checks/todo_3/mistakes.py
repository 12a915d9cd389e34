"""Known mistakes in TODO 3, as models of what one solve does to a rod.

A model gives the velocities of both ends; a pass does not move them. If neither end can move, the
only known mistake is the division by 0.
"""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.checks.exact import Pair, Rod
from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import Undecided, truth

Ends = tuple[Pair, Pair]
Model = Callable[[Rod], Ends]
Answer = tuple[Pair, Pair, Pair]  # velocities of A and B, px/s; B as seen from A, px


def solve_rod(rod: Rod) -> Answer:
    ends = exact.rod_solved(rod) if rod.k else (rod.vel_a, rod.vel_b)
    return (*ends, rod.offset)


def describe_rod(rod: Rod) -> dict[str, str]:
    """Return what moves, and what the rod has to do, in words."""
    names = [name for name, mass in (("A", rod.mass_a), ("B", rod.mass_b)) if mass]
    moves = {"": "no end can move", "A": "only A can move", "B": "only B can move"}
    off = math.hypot(*rod.offset) - rod.length
    exact_length = abs(off) <= 1e-9 * rod.length
    speeds = rod.vel_a, rod.vel_b
    resting = [name for name, vel in zip("AB", speeds, strict=True) if not any(vel)]
    rest = {"": "both ends move", "A": "A rests", "B": "B rests", "AB": "both ends rest"}
    closing = rod.speed
    return {
        "moves": moves.get("".join(names), "both ends can move"),
        "length": "the rod is as long as meant"
        if exact_length
        else f"the rod is {'stretched' if off > 0 else 'squeezed'}",
        "_rest": rest["".join(resting)],
        "_speed": "the ends keep their distance"
        if abs(closing) < 1e-9
        else f"the ends {'part' if closing > 0 else 'close'}",
        "_masses": f"the masses are {'equal' if rod.mass_a == rod.mass_b else 'different'}",
    }


PARTS = {"the velocity of A": [0, 1], "the velocity of B": [2, 3], "the position of B": [4, 5]}

truth("rod", solve_rod, describe_rod, PARTS, apart=True)

known = known_in("3", "rod")


def velocities(model: Model) -> Callable[[Rod], Answer]:
    """Return a model that changes only velocities, if an end can move."""

    def answer(rod: Rod) -> Answer:
        if not rod.k:
            raise Undecided
        return (*model(rod), rod.offset)

    return answer


known("divides-by-a-k-of-0", lambda rod: solve_rod(rod) if rod.k else "ZeroDivisionError")


def right_impulse(rod: Rod) -> float:
    return (rod.bias - rod.speed) / rod.k


def add_along(vel: Pair, axis: Pair, by: float) -> Pair:
    return vel[0] + by * axis[0], vel[1] + by * axis[1]


known("only-pulls", velocities(lambda rod: exact.push_ends(rod, min(0.0, right_impulse(rod)))))
known("only-pushes", velocities(lambda rod: exact.push_ends(rod, max(0.0, right_impulse(rod)))))
known("ignores-the-bias", velocities(lambda rod: exact.push_ends(rod, -rod.speed / rod.k)))
known("ignores-the-speed", velocities(lambda rod: exact.push_ends(rod, rod.bias / rod.k)))


def push_for_speed(rod: Rod, seen: Rod) -> Ends:
    """Return the velocities after the impulse for another rod, one end of which rests."""
    return exact.push_ends(rod, (rod.bias - seen.speed) / rod.k)


known(
    "speed-of-b-alone", velocities(lambda rod: push_for_speed(rod, rod._replace(vel_a=(0.0, 0.0))))
)
known(
    "speed-of-a-alone", velocities(lambda rod: push_for_speed(rod, rod._replace(vel_b=(0.0, 0.0))))
)
known(
    "adds-the-speed", velocities(lambda rod: exact.push_ends(rod, (rod.bias + rod.speed) / rod.k))
)
known("pushes-the-wrong-way", velocities(lambda rod: exact.push_ends(rod, -right_impulse(rod))))
known(
    "multiplies-by-k", velocities(lambda rod: exact.push_ends(rod, (rod.bias - rod.speed) * rod.k))
)
known("not-divided-by-k", velocities(lambda rod: exact.push_ends(rod, rod.bias - rod.speed)))
known(
    "bias-has-the-wrong-sign",
    velocities(lambda rod: exact.push_ends(rod, (-rod.bias - rod.speed) / rod.k)),
)
known("impulse-is-not-applied", velocities(lambda rod: (rod.vel_a, rod.vel_b)))
known(
    "moves-only-a", velocities(lambda rod: (exact.push_ends(rod, right_impulse(rod))[0], rod.vel_b))
)
known(
    "moves-only-b", velocities(lambda rod: (rod.vel_a, exact.push_ends(rod, right_impulse(rod))[1]))
)
known(
    "b-does-it-all",
    velocities(lambda rod: (rod.vel_a, add_along(rod.vel_b, rod.axis, rod.bias - rod.speed))),
)


def speed_of_lengths(rod: Rod) -> float:
    return math.hypot(*rod.vel_b) - math.hypot(*rod.vel_a)


known(
    "speeds-by-their-lengths",
    velocities(lambda rod: exact.push_ends(rod, (rod.bias - speed_of_lengths(rod)) / rod.k)),
)


def length_error(rod: Rod) -> float:
    return rod.length - math.hypot(*rod.offset)


known(
    "length-error-for-the-bias",
    velocities(lambda rod: exact.push_ends(rod, (length_error(rod) - rod.speed) / rod.k)),
    velocities(lambda rod: exact.push_ends(rod, (-length_error(rod) - rod.speed) / rod.k)),
)


def impulse_made_anew(rod: Rod) -> Ends:
    """Work the impulse out twice: the second time A has changed."""
    a, _ = exact.push_ends(rod, right_impulse(rod))
    return a, exact.push_ends(rod, right_impulse(rod._replace(vel_a=a)))[1]


def impulse_made_anew_for_a(rod: Rod) -> Ends:
    _, b = exact.push_ends(rod, right_impulse(rod))
    return exact.push_ends(rod, right_impulse(rod._replace(vel_b=b)))[0], b


known("impulse-made-anew", velocities(impulse_made_anew), velocities(impulse_made_anew_for_a))
known(
    "nothing-where-bias-is-0",
    velocities(
        lambda rod: (
            exact.push_ends(rod, right_impulse(rod))
            if abs(math.hypot(*rod.offset) - rod.length) > 1e-9 * rod.length
            else (rod.vel_a, rod.vel_b)
        )
    ),
)


@known("velocity-changed-in-place")
@velocities
def velocity_changed_in_place(rod: Rod) -> Ends:
    a, (x, y) = exact.push_ends(rod, right_impulse(rod))
    return a, (x - rod.vel_a[0], y - rod.vel_a[1])


@known("pushes-both-the-same-way")
@velocities
def pushes_both_the_same_way(rod: Rod) -> Ends:
    by = right_impulse(rod) * exact.inverse(rod.mass_a)
    return add_along(rod.vel_a, rod.axis, by), exact.push_ends(rod, right_impulse(rod))[1]


@known("static-end-first")
@velocities
def static_end_first(rod: Rod) -> Ends:
    if rod.mass_b:
        return exact.push_ends(rod, right_impulse(rod))
    by = right_impulse(rod) * exact.inverse(rod.mass_a)
    return add_along(rod.vel_a, rod.axis, by), rod.vel_b


def without_masses(rod: Rod) -> Ends:
    by = right_impulse(rod)
    return add_along(rod.vel_a, rod.axis, -by), add_along(rod.vel_b, rod.axis, by)


known("forgets-the-masses", velocities(without_masses))
known(
    "forgets-the-mass-of-a",
    velocities(lambda rod: (without_masses(rod)[0], exact.push_ends(rod, right_impulse(rod))[1])),
)
known(
    "forgets-the-mass-of-b",
    velocities(lambda rod: (exact.push_ends(rod, right_impulse(rod))[0], without_masses(rod)[1])),
)
known("half-of-the-impulse", velocities(lambda rod: exact.push_ends(rod, right_impulse(rod) / 2)))


@known("masses-crossed")
@velocities
def masses_crossed(rod: Rod) -> Ends:
    by = right_impulse(rod)
    a, b = by * exact.inverse(rod.mass_b), by * exact.inverse(rod.mass_a)
    return add_along(rod.vel_a, rod.axis, -a), add_along(rod.vel_b, rod.axis, b)


@known("axis-is-not-a-unit-vector")
@velocities
def axis_is_not_a_unit_vector(rod: Rod) -> Ends:
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.offset
    impulse = (rod.bias - ((bx - ax) * x + (by - ay) * y)) / rod.k
    a, b = (impulse * exact.inverse(mass) for mass in (rod.mass_a, rod.mass_b))
    return add_along(rod.vel_a, rod.offset, -a), add_along(rod.vel_b, rod.offset, b)


@known("velocities-are-replaced")
@velocities
def velocities_are_replaced(rod: Rod) -> Ends:
    still = rod._replace(vel_a=(0.0, 0.0), vel_b=(0.0, 0.0))
    return exact.push_ends(still, right_impulse(rod))


@known("shares-equally")
@velocities
def shares_equally(rod: Rod) -> Ends:
    by = (rod.bias - rod.speed) / 2
    return add_along(rod.vel_a, rod.axis, -by), add_along(rod.vel_b, rod.axis, by)


@known("stops-the-sideways-speed")
@velocities
def stops_the_sideways_speed(rod: Rod) -> Ends:
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    wanted = rod.bias * x - (bx - ax), rod.bias * y - (by - ay)
    size = math.hypot(*wanted)
    if size == 0:
        return rod.vel_a, rod.vel_b
    direction = wanted[0] / size, wanted[1] / size
    a, b = (size / rod.k * exact.inverse(mass) for mass in (rod.mass_a, rod.mass_b))
    return add_along(rod.vel_a, direction, -a), add_along(rod.vel_b, direction, b)


@known("moves-positions-instead")
def moves_positions_instead(rod: Rod) -> Answer:
    if not rod.k:
        raise Undecided
    return rod.vel_a, rod.vel_b, (rod.axis[0] * rod.length, rod.axis[1] * rod.length)


@known("speed-in-every-direction")
@velocities
def speed_in_every_direction(rod: Rod) -> Ends:
    (ax, ay), (bx, by) = rod.vel_a, rod.vel_b
    return exact.push_ends(rod, (rod.bias - math.hypot(bx - ax, by - ay)) / rod.k)


def by_one_mass(rod: Rod, mass: float) -> Ends:
    if not mass:
        raise Undecided  # a division by 0
    return exact.push_ends(rod, (rod.bias - rod.speed) * mass)


known(
    "k-of-one-end",
    velocities(lambda rod: by_one_mass(rod, rod.mass_b)),
    velocities(lambda rod: by_one_mass(rod, rod.mass_a)),
)
known(
    "distance-for-speed",
    velocities(lambda rod: exact.push_ends(rod, (rod.bias - math.hypot(*rod.offset)) / rod.k)),
)
