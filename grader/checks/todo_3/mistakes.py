"""Known mistakes in TODO 3, as models of what one solve does to a rod.

A model gives the velocities of both ends; a pass does not move them. If neither end can move, the
only known mistake is the division by 0.
"""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.checks.exact import Pair, Rod, inverse
from grader.checks.mistakes import Models, register
from grader.judge.explain.misconceptions import Kind, Undecided, kinds

Ends = tuple[Pair, Pair]
Answer = tuple[Pair, Pair, Pair]  # velocities of A and B, px/s; B as seen from A, px


def solve_rod(rod: Rod) -> Answer:
    ends = exact.solve_rod(rod) if rod.k else (rod.vel_a, rod.vel_b)
    return (*ends, rod.offset)


def describe_rod(rod: Rod) -> dict[str, str]:
    """Describe in words which ends move and what the rod has to do."""
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

kinds["rod"] = Kind(solve_rod, describe_rod, PARTS, apart=True)


Impulse = Callable[[Rod], float]

STILL = (0.0, 0.0)


def fail_without_masses(rod: Rod) -> Answer | str:
    return solve_rod(rod) if rod.k else "ZeroDivisionError"


def velocities(model: Callable[[Rod], Ends]) -> Callable[[Rod], Answer]:
    """Return a model that changes only velocities, if an end can move."""

    def answer(rod: Rod) -> Answer:
        if not rod.k:
            raise Undecided
        return (*model(rod), rod.offset)

    return answer


# ---------------------------------------------------------------- another impulse for both ends


def push(impulse: Impulse) -> Callable[[Rod], Ends]:
    """Return the right model with another impulse."""
    return lambda rod: exact.push_ends(rod, impulse(rod))


def right_impulse(rod: Rod) -> float:
    return (rod.bias - rod.speed) / rod.k


def with_speed(speed: Impulse) -> Callable[[Rod], Ends]:
    """Return the right model with another speed along the rod."""
    return push(lambda rod: (rod.bias - speed(rod)) / rod.k)


def with_bias(bias: Impulse) -> Callable[[Rod], Ends]:
    return push(lambda rod: (bias(rod) - rod.speed) / rod.k)


def length_error(rod: Rod) -> float:
    return rod.length - math.hypot(*rod.offset)


def difference_of_lengths(rod: Rod) -> float:
    return math.hypot(*rod.vel_b) - math.hypot(*rod.vel_a)


def speed_in_every_direction(rod: Rod) -> float:
    (ax, ay), (bx, by) = rod.vel_a, rod.vel_b
    return math.hypot(bx - ax, by - ay)


def mass_of(mass: float) -> float:
    """Return an end's mass; undecided if static, as the mistake then divides by 0."""
    if not mass:
        raise Undecided
    return mass


# ---------------------------------------------------------------- the ends apart


def add_along(vel: Pair, axis: Pair, by: float) -> Pair:
    return vel[0] + by * axis[0], vel[1] + by * axis[1]


def push_a(rod: Rod) -> Pair:
    return exact.push_ends(rod, right_impulse(rod))[0]


def push_b(rod: Rod) -> Pair:
    return exact.push_ends(rod, right_impulse(rod))[1]


def push_a_the_same_way(rod: Rod) -> Pair:
    return add_along(rod.vel_a, rod.axis, right_impulse(rod) * inverse(rod.mass_a))


def push_by(rod: Rod, a: float, b: float, axis: Pair) -> Ends:
    """Return both velocities if A loses `a`, B gains `b` (px/s) along `axis`."""
    return add_along(rod.vel_a, axis, -a), add_along(rod.vel_b, axis, b)


def push_both(rod: Rod, impulse: float, axis: Pair) -> Ends:
    return push_by(rod, impulse * inverse(rod.mass_a), impulse * inverse(rod.mass_b), axis)


def forget_masses(rod: Rod) -> Ends:
    return push_by(rod, right_impulse(rod), right_impulse(rod), rod.axis)


def cross_masses(rod: Rod) -> Ends:
    by = right_impulse(rod)
    return push_by(rod, by * inverse(rod.mass_b), by * inverse(rod.mass_a), rod.axis)


def push_along_offset(rod: Rod) -> Ends:
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.offset
    return push_both(rod, (rod.bias - ((bx - ax) * x + (by - ay) * y)) / rod.k, rod.offset)


def stop_sideways_speed(rod: Rod) -> Ends:
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    wanted = rod.bias * x - (bx - ax), rod.bias * y - (by - ay)
    size = math.hypot(*wanted)
    if size == 0:
        return rod.vel_a, rod.vel_b
    return push_both(rod, size / rod.k, (wanted[0] / size, wanted[1] / size))


def share_equally(rod: Rod) -> Ends:
    by = (rod.bias - rod.speed) / 2
    return push_by(rod, by, by, rod.axis)


def change_in_place(rod: Rod) -> Ends:
    a, (x, y) = exact.solve_rod(rod)
    return a, (x - rod.vel_a[0], y - rod.vel_a[1])


def skip_if_exact(rod: Rod) -> Ends:
    is_exact = abs(length_error(rod)) <= 1e-9 * rod.length
    return (rod.vel_a, rod.vel_b) if is_exact else exact.solve_rod(rod)


MODELS: Models = (
    ("only-pulls", push(lambda rod: min(0.0, right_impulse(rod)))),
    ("only-pushes", push(lambda rod: max(0.0, right_impulse(rod)))),
    ("ignores-the-bias", with_bias(lambda rod: 0.0)),
    ("ignores-the-speed", with_speed(lambda rod: 0.0)),
    ("speed-of-b-alone", with_speed(lambda rod: rod._replace(vel_a=STILL).speed)),
    ("speed-of-a-alone", with_speed(lambda rod: rod._replace(vel_b=STILL).speed)),
    ("adds-the-speed", with_speed(lambda rod: -rod.speed)),
    ("pushes-the-wrong-way", push(lambda rod: -right_impulse(rod))),
    ("multiplies-by-k", push(lambda rod: (rod.bias - rod.speed) * rod.k)),
    ("not-divided-by-k", push(lambda rod: rod.bias - rod.speed)),
    ("bias-has-the-wrong-sign", with_bias(lambda rod: -rod.bias)),
    ("impulse-is-not-applied", lambda rod: (rod.vel_a, rod.vel_b)),
    ("moves-only-a", lambda rod: (push_a(rod), rod.vel_b)),
    ("moves-only-b", lambda rod: (rod.vel_a, push_b(rod))),
    ("b-does-it-all", lambda rod: push_by(rod, 0.0, rod.bias - rod.speed, rod.axis)),
    ("speeds-by-their-lengths", with_speed(difference_of_lengths)),
    ("length-error-for-the-bias", with_bias(length_error)),
    ("length-error-for-the-bias", with_bias(lambda rod: -length_error(rod))),
    ("impulse-made-anew", lambda rod: (push_a(rod), push_b(rod._replace(vel_a=push_a(rod))))),
    ("impulse-made-anew", lambda rod: (push_a(rod._replace(vel_b=push_b(rod))), push_b(rod))),
    ("nothing-where-bias-is-0", skip_if_exact),
    ("velocity-changed-in-place", change_in_place),
    ("pushes-both-the-same-way", lambda rod: (push_a_the_same_way(rod), push_b(rod))),
    (
        "static-end-first",
        lambda rod: (push_a(rod) if rod.mass_b else push_a_the_same_way(rod), push_b(rod)),
    ),
    ("forgets-the-masses", forget_masses),
    ("forgets-the-mass-of-a", lambda rod: (forget_masses(rod)[0], push_b(rod))),
    ("forgets-the-mass-of-b", lambda rod: (push_a(rod), forget_masses(rod)[1])),
    ("half-of-the-impulse", push(lambda rod: right_impulse(rod) / 2)),
    ("masses-crossed", cross_masses),
    ("axis-is-not-a-unit-vector", push_along_offset),
    (
        "velocities-are-replaced",
        lambda rod: exact.push_ends(rod._replace(vel_a=STILL, vel_b=STILL), right_impulse(rod)),
    ),
    ("shares-equally", share_equally),
    ("stops-the-sideways-speed", stop_sideways_speed),
    ("speed-in-every-direction", with_speed(speed_in_every_direction)),
    ("k-of-one-end", push(lambda rod: (rod.bias - rod.speed) * mass_of(rod.mass_b))),
    ("k-of-one-end", push(lambda rod: (rod.bias - rod.speed) * mass_of(rod.mass_a))),
    ("distance-for-speed", with_speed(lambda rod: math.hypot(*rod.offset))),
)


def move_positions(rod: Rod) -> Answer:
    if not rod.k:
        raise Undecided
    return rod.vel_a, rod.vel_b, (rod.axis[0] * rod.length, rod.axis[1] * rod.length)


register("3", "rod", [("divides-by-a-k-of-0", fail_without_masses)])
register("3", "rod", ((name, velocities(model)) for name, model in MODELS))
register("3", "rod", [("moves-positions-instead", move_positions)])
