"""Known mistakes in TODO 3, as models of what one solve does to a rod.

A model gives the velocities of both ends; a pass leaves the places as they are. Where neither end
can move, one mistake alone is known: the division by 0.
"""

import math
from collections.abc import Callable
from functools import partial

from grader.checks import exact
from grader.checks.exact import Pair, Rod
from grader.judge.misconceptions import Undecided, mistake, truth

Ends = tuple[Pair, Pair]
Model = Callable[[Rod], Ends]
Answer = tuple[Pair, Pair, Pair]  # velocities of A and B, px/s; B as seen from A, px


def right(rod: Rod) -> Answer:
    ends = exact.rod_solved(rod) if rod.k else (rod.vel_a, rod.vel_b)
    return (*ends, rod.offset)


def like(rod: Rod) -> dict[str, str]:
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

truth("rod", right, like, PARTS, apart=True)

known = partial(mistake, "3", "rod")


def velocities(model: Model) -> Callable[[Rod], Answer]:
    """Return a mistake in the velocities alone, where an end can move."""

    def answer(rod: Rod) -> Answer:
        if not rod.k:
            raise Undecided
        return (*model(rod), rod.offset)

    return answer


known(
    "divides-by-a-k-of-0",
    "Where neither end can move, k is 0 and nothing can be divided by it: do nothing then.",
    lambda rod: right(rod) if rod.k else "ZeroDivisionError",
)


def right_impulse(rod: Rod) -> float:
    return (rod.bias - rod.speed) / rod.k


def moved(vel: Pair, axis: Pair, by: float) -> Pair:
    return vel[0] + by * axis[0], vel[1] + by * axis[1]


known(
    "only-pulls",
    "The rod only pulls, like a rope; a rod also pushes when it is too short.",
    velocities(lambda rod: exact.pushed(rod, min(0.0, right_impulse(rod)))),
)
known(
    "only-pushes",
    "The impulse is clamped like a contact's; a rod needs no clamp, it also pulls.",
    velocities(lambda rod: exact.pushed(rod, max(0.0, right_impulse(rod)))),
)
known(
    "ignores-the-bias",
    "The bias is left out: the rod never wins back the length it has lost.",
    velocities(lambda rod: exact.pushed(rod, -rod.speed / rod.k)),
)
known(
    "ignores-the-speed",
    "The speed along the rod is left out; the impulse is for what is missing.",
    velocities(lambda rod: exact.pushed(rod, rod.bias / rod.k)),
)


def as_seen(rod: Rod, seen: Rod) -> Ends:
    """After the impulse for the speed of another rod, of which one end rests."""
    return exact.pushed(rod, (rod.bias - seen.speed) / rod.k)


known(
    "speed-of-b-alone",
    "The speed of B alone counts; it is B's speed away from A that bias is for.",
    velocities(lambda rod: as_seen(rod, rod._replace(vel_a=(0.0, 0.0)))),
)
known(
    "speed-of-a-alone",
    "The speed of A alone counts; it is B's speed away from A that bias is for.",
    velocities(lambda rod: as_seen(rod, rod._replace(vel_b=(0.0, 0.0)))),
)
known(
    "adds-the-speed",
    "The speed counts with the wrong sign: it must be B's minus A's, taken from the bias.",
    velocities(lambda rod: exact.pushed(rod, (rod.bias + rod.speed) / rod.k)),
)
known(
    "pushes-the-wrong-way",
    "Both ends are pushed the wrong way: of (bias - speed) / k, A gets -impulse and B +impulse.",
    velocities(lambda rod: exact.pushed(rod, -right_impulse(rod))),
)
known(
    "multiplies-by-k",
    "The impulse is multiplied by k; k is speed per impulse, so divide by it.",
    velocities(lambda rod: exact.pushed(rod, (rod.bias - rod.speed) * rod.k)),
)
known(
    "not-divided-by-k",
    "The impulse lacks the division by k, the speed that one unit of it gives.",
    velocities(lambda rod: exact.pushed(rod, rod.bias - rod.speed)),
)
known(
    "bias-has-the-wrong-sign",
    "The bias has the wrong sign: a stretched rod is stretched further.",
    velocities(lambda rod: exact.pushed(rod, (-rod.bias - rod.speed) / rod.k)),
)
known(
    "impulse-is-not-applied",
    "No velocity changes: the impulse must reach both ends, and do so unless k is 0.",
    velocities(lambda rod: (rod.vel_a, rod.vel_b)),
)
known(
    "moves-only-a",
    "Only A gets the impulse; B must get the opposite one.",
    velocities(lambda rod: (exact.pushed(rod, right_impulse(rod))[0], rod.vel_b)),
)
known(
    "moves-only-b",
    "Only B gets the impulse; A must get the opposite one.",
    velocities(lambda rod: (rod.vel_a, exact.pushed(rod, right_impulse(rod))[1])),
)
known(
    "b-does-it-all",
    "B changes speed for both, as if A were static; each end takes the impulse by its inv_mass.",
    velocities(lambda rod: (rod.vel_a, moved(rod.vel_b, rod.axis, rod.bias - rod.speed))),
)


def speed_of_lengths(rod: Rod) -> float:
    return math.hypot(*rod.vel_b) - math.hypot(*rod.vel_a)


known(
    "speeds-by-their-lengths",
    "The speeds are compared by their lengths; only the part along the rod counts: a dot product.",
    velocities(lambda rod: exact.pushed(rod, (rod.bias - speed_of_lengths(rod)) / rod.k)),
)


def length_error(rod: Rod) -> float:
    return rod.length - math.hypot(*rod.offset)


known(
    "length-error-for-the-bias",
    "The error of the length is used as a speed; bias has it already, as a share per dt.",
    velocities(lambda rod: exact.pushed(rod, (length_error(rod) - rod.speed) / rod.k)),
    velocities(lambda rod: exact.pushed(rod, (-length_error(rod) - rod.speed) / rod.k)),
)


def impulse_made_anew(rod: Rod) -> Ends:
    """Of two lines that each work out the impulse: the second one sees A changed."""
    a, _ = exact.pushed(rod, right_impulse(rod))
    return a, exact.pushed(rod, right_impulse(rod._replace(vel_a=a)))[1]


def impulse_made_anew_for_a(rod: Rod) -> Ends:
    _, b = exact.pushed(rod, right_impulse(rod))
    return exact.pushed(rod, right_impulse(rod._replace(vel_b=b)))[0], b


known(
    "impulse-made-anew",
    "The impulse is worked out again after one end has changed: do it once, for both ends.",
    velocities(impulse_made_anew),
    velocities(impulse_made_anew_for_a),
)


known(
    "nothing-where-bias-is-0",
    "Nothing happens where the bias is 0; it is k that may be 0. A rod of the right length has to "
    "stop its ends as well.",
    velocities(
        lambda rod: (
            exact.pushed(rod, right_impulse(rod))
            if abs(math.hypot(*rod.offset) - rod.length) > 1e-9 * rod.length
            else (rod.vel_a, rod.vel_b)
        )
    ),
)


def speed_taken_from_b(rod: Rod) -> Ends:
    a, (x, y) = exact.pushed(rod, right_impulse(rod))
    return a, (x - rod.vel_a[0], y - rod.vel_a[1])


known(
    "velocity-changed-in-place",
    "B loses the velocity of A. After v = self.b.vel, v -= ... changes the body itself: make a new "
    "vector, self.b.vel - self.a.vel.",
    velocities(speed_taken_from_b),
)


def same_way(rod: Rod) -> Ends:
    by = right_impulse(rod) * exact.inverse(rod.mass_a)
    return moved(rod.vel_a, rod.axis, by), exact.pushed(rod, right_impulse(rod))[1]


known(
    "pushes-both-the-same-way",
    "Both ends get the same impulse; A must get the opposite one.",
    velocities(same_way),
)


def static_end_first(rod: Rod) -> Ends:
    if rod.mass_b:
        return exact.pushed(rod, right_impulse(rod))
    by = right_impulse(rod) * exact.inverse(rod.mass_a)
    return moved(rod.vel_a, rod.axis, by), rod.vel_b


known(
    "static-end-first",
    "A moves the wrong way where B is static: A gets the opposite of what B would get.",
    velocities(static_end_first),
)


def without_masses(rod: Rod) -> Ends:
    by = right_impulse(rod)
    return moved(rod.vel_a, rod.axis, -by), moved(rod.vel_b, rod.axis, by)


known(
    "forgets-the-masses",
    "The impulse is added to the velocities as it is: multiply it by the inv_mass of each end.",
    velocities(without_masses),
)


known(
    "forgets-the-mass-of-a",
    "The velocity of A changes by the impulse itself; it must change by impulse * inv_mass of A.",
    velocities(lambda rod: (without_masses(rod)[0], exact.pushed(rod, right_impulse(rod))[1])),
)
known(
    "forgets-the-mass-of-b",
    "The velocity of B changes by the impulse itself; it must change by impulse * inv_mass of B.",
    velocities(lambda rod: (exact.pushed(rod, right_impulse(rod))[0], without_masses(rod)[1])),
)
known(
    "half-of-the-impulse",
    "The impulse is half of what it must be: k has the masses of both ends in it already.",
    velocities(lambda rod: exact.pushed(rod, right_impulse(rod) / 2)),
)


def masses_crossed(rod: Rod) -> Ends:
    by = right_impulse(rod)
    a, b = by * exact.inverse(rod.mass_b), by * exact.inverse(rod.mass_a)
    return moved(rod.vel_a, rod.axis, -a), moved(rod.vel_b, rod.axis, b)


known(
    "masses-crossed",
    "Each end takes the impulse by the mass of the other one; inv_mass of A is for A.",
    velocities(masses_crossed),
)


def axis_too_long(rod: Rod) -> Ends:
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.offset
    impulse = (rod.bias - ((bx - ax) * x + (by - ay) * y)) / rod.k
    a, b = (impulse * exact.inverse(mass) for mass in (rod.mass_a, rod.mass_b))
    return moved(rod.vel_a, rod.offset, -a), moved(rod.vel_b, rod.offset, b)


known(
    "axis-is-not-a-unit-vector",
    "The axis is as long as the rod; self.axis has the length 1, as prepare() has made it.",
    velocities(axis_too_long),
)


def replaced(rod: Rod) -> Ends:
    still = rod._replace(vel_a=(0.0, 0.0), vel_b=(0.0, 0.0))
    return exact.pushed(still, right_impulse(rod))


known(
    "velocities-are-replaced",
    "Each velocity becomes the change alone; the change must be added to the velocity it had.",
    velocities(replaced),
)


def halves(rod: Rod) -> Ends:
    by = (rod.bias - rod.speed) / 2
    return moved(rod.vel_a, rod.axis, -by), moved(rod.vel_b, rod.axis, by)


known(
    "shares-equally",
    "Both ends change speed alike; the lighter one must change more.",
    velocities(halves),
)


def whole_velocity(rod: Rod) -> Ends:
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    wanted = rod.bias * x - (bx - ax), rod.bias * y - (by - ay)
    size = math.hypot(*wanted)
    if size == 0:
        return rod.vel_a, rod.vel_b
    direction = wanted[0] / size, wanted[1] / size
    a, b = (size / rod.k * exact.inverse(mass) for mass in (rod.mass_a, rod.mass_b))
    return moved(rod.vel_a, direction, -a), moved(rod.vel_b, direction, b)


known(
    "stops-the-sideways-speed",
    "The whole velocity is taken away; only its part along the rod may be.",
    velocities(whole_velocity),
)


def placed(rod: Rod) -> Answer:
    if not rod.k:
        raise Undecided
    return rod.vel_a, rod.vel_b, (rod.axis[0] * rod.length, rod.axis[1] * rod.length)


known(
    "moves-positions-instead",
    "The ends are put in place; a pass changes velocities, and the step moves the bodies.",
    placed,
)


def by_whole_speed(rod: Rod) -> Ends:
    (ax, ay), (bx, by) = rod.vel_a, rod.vel_b
    return exact.pushed(rod, (rod.bias - math.hypot(bx - ax, by - ay)) / rod.k)


known(
    "speed-in-every-direction",
    "The whole speed of B as seen from A counts; only its part along the axis does: a dot product.",
    velocities(by_whole_speed),
)


def by_one_mass(rod: Rod, mass: float) -> Ends:
    if not mass:
        raise Undecided  # a division by 0
    return exact.pushed(rod, (rod.bias - rod.speed) * mass)


known(
    "k-of-one-end",
    "The impulse is divided by the inverse mass of one end; k is the sum of both.",
    velocities(lambda rod: by_one_mass(rod, rod.mass_b)),
    velocities(lambda rod: by_one_mass(rod, rod.mass_a)),
)
known(
    "distance-for-speed",
    "The distance between the ends stands for their speed: it is the velocities' part along the "
    "axis.",
    velocities(lambda rod: exact.pushed(rod, (rod.bias - math.hypot(*rod.offset)) / rod.k)),
)
