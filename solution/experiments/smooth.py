"""The four integrators of integrators.py where the exact answer is known: error against cost.

Every system here is smooth: no contacts. Each is run at many step sizes; the error is how far the
end is from the exact one, and the cost is how often the acceleration had to be worked out. One
that was just worked out is kept: Verlet ends each step where the next one begins.
"""

import math
from dataclasses import dataclass

import integrators

from .engines import ENGINES
from .measures import run
from .scenes import DT, Ball, G, Scene, pendulum_period

METHODS = (
    integrators.explicit_euler,
    integrators.semi_implicit_euler,
    integrators.velocity_verlet,
    integrators.rk4,
)
SETTLED = 0.05  # an error below this share of the system's size follows the method's order
ROUNDING = 2e-12  # below this share, rounding of the numbers hides the method's error
FINEST = 3  # so many points, the finest of those in between, make the measured order


@dataclass
class System:
    """A body that moves without contacts, and where it is in the end.

    Positions may be complex numbers: the real part is x, the imaginary part y. The methods add and
    multiply, so they work on those as they are.
    """

    title: str
    unit: str
    start: tuple  # position, velocity
    end: tuple  # exactly, after seconds
    seconds: float
    accel: object  # accel(x)
    size: float  # the largest position
    rate: float  # 1/s: a velocity error divided by it counts as a position error
    orders: tuple  # expected, one per method
    steps: int  # of the coarsest run
    halvings: tuple  # of the step, the first and the last, one pair per method


def spring():
    """A weight on a spring of 1 Hz, stopped off-phase: after 10 whole periods errors cancel."""
    omega, seconds = integrators.OMEGA, 9.75
    start = (integrators.X0, 0.0)
    end = (
        integrators.X0 * math.cos(omega * seconds),
        -integrators.X0 * omega * math.sin(omega * seconds),
    )
    size, accel, halvings = integrators.X0, integrators.spring, ((2, 11), (0, 8), (0, 8), (0, 8))
    orders = (1, 1, 2, 4)
    return System("spring", "px", start, end, seconds, accel, size, omega, orders, 156, halvings)


def kepler():
    """A planet on an ellipse (e = 0.5, half axis 100 px, once round per second), for 10 rounds.

    Started where it is nearest to the sun. There a semi-implicit step is a Verlet step seen half
    a kick later, so after whole rounds its error shrinks with the square of the step.
    """
    half_axis, e, omega = 100.0, 0.5, 2 * math.pi
    pull = omega**2 * half_axis**3  # px³/s²
    start = (complex(half_axis * (1 - e)), 1j * omega * half_axis * math.sqrt((1 + e) / (1 - e)))

    def accel(x):
        return -pull * x / abs(x) ** 3

    halvings, orders = ((2, 5), (0, 7), (0, 7), (0, 6)), (1, 2, 2, 4)
    return System("orbit", "px", start, start, 10.0, accel, 150.0, omega, orders, 1280, halvings)


def pendulum():
    """The angle of a pendulum let go at 90°, stopped off-phase as it passes the lowest point."""
    omega = math.sqrt(G / 140)  # 1/s, of small swings
    seconds = 1.75 * pendulum_period(140, 90)
    end = (0.0, omega * math.sqrt(2))  # by its energy

    def accel(x):
        return -(omega**2) * math.sin(x)

    start, halvings, orders = (math.pi / 2, 0.0), ((4, 12), (0, 8), (0, 8), (0, 8)), (1, 1, 2, 4)
    return System(
        "pendulum", "rad", start, end, seconds, accel, start[0], omega, orders, 28, halvings
    )


SYSTEMS = (spring, kepler, pendulum)


# ---------------------------------------------------------------- error against step and cost


def study(system, methods=METHODS, most=math.inf):
    """Each method at step sizes that halve, with its measured order. Runs have most steps."""
    found = []
    for method, expected, (first, last) in zip(
        methods, system.orders, system.halvings, strict=True
    ):
        counts = [system.steps * 2**k for k in range(first, last + 1)]
        points = [measure(system, method, steps) for steps in counts if steps <= most]
        order = measured_order(points, system.size)
        found.append(
            {"method": method.__name__, "expected": expected, "order": order, "points": points}
        )
    about = {"title": system.title, "unit": system.unit, "size": system.size}
    return {**about, "methods": found}


class Kept:
    """An acceleration that remembers its last answer, and counts how often it worked one out."""

    def __init__(self, accel):
        self.accel, self.calls, self.place, self.answer = accel, 0, None, None

    def __call__(self, x):
        if x != self.place:
            self.calls += 1
            self.place, self.answer = x, self.accel(x)
        return self.answer


def measure(system, method, steps):
    """One run in so many steps: its step (s), its calls of accel, and its error or what failed."""
    accel = Kept(system.accel)
    dt = system.seconds / steps
    x, v = system.start
    try:
        for _ in range(steps):
            x, v = method(x, v, dt, accel)
        error = distance(system, x, v)
        error = error if math.isfinite(error) else "blown up"
    except ArithmeticError:
        error = "blown up"
    except Exception as problem:  # the method is a student's
        error = type(problem).__name__
    return {"dt": dt, "calls": accel.calls, "error": error}


def distance(system, x, v):
    """How far a position and a velocity are from the exact ones, in the system's unit."""
    return math.hypot(abs(x - system.end[0]), abs(v - system.end[1]) / system.rate)


def measured_order(points, size):
    """The slope of log error over log step where errors are small but not rounding, or None."""
    low, high = ROUNDING * size, SETTLED * size
    kept = [p for p in points if not isinstance(p["error"], str) and low < p["error"] < high]
    if len(kept) < FINEST:
        return None
    return slope([(p["dt"], p["error"]) for p in kept[-FINEST:]])


def slope(pairs):
    """The least-squares slope of log y over log x."""
    xs = [math.log(x) for x, _ in pairs]
    ys = [math.log(y) for _, y in pairs]
    x_mean, y_mean = sum(xs) / len(xs), sum(ys) / len(ys)
    over = sum((x - x_mean) * (y - y_mean) for x, y in zip(xs, ys, strict=True))
    return over / sum((x - x_mean) ** 2 for x in xs)


# ---------------------------------------------------------------- energy of an orbit


ENERGY_ROUNDS, ENERGY_CALLS = 300, 400  # rounds of the orbit, and evaluations in each
CALLS = {"rk4": 4}  # evaluations in a step, where they are more than 1


def energy_peaks(method, rounds=ENERGY_ROUNDS):
    """The largest relative energy error in each round, all methods at equal evaluations."""
    steps = ENERGY_CALLS // CALLS.get(method.__name__, 1)
    system = kepler()
    pull = abs(system.accel(1.0))

    def energy(x, v):
        return abs(v) ** 2 / 2 - pull / abs(x)

    x, v = system.start
    start, peaks = energy(x, v), []
    try:
        for _ in range(rounds):
            peak = 0.0
            for _ in range(steps):
                x, v = method(x, v, 1 / steps, system.accel)
                peak = max(peak, abs(energy(x, v) / start - 1))
            peaks.append(peak)
    except Exception as problem:
        peaks.append(type(problem).__name__)
    return peaks


def energy_study(methods=METHODS):
    """Whether the energy error of an orbit stays bounded: no larger in the last round.

    "passes Verlet" is the round from which on it is larger than Verlet's, or None.
    """
    found = []
    for method in methods:
        peaks = energy_peaks(method)
        whole = not isinstance(peaks[-1], str)
        growth = peaks[-1] / peaks[0] if whole and peaks[0] else None
        bounded = growth is not None and growth < 1.5
        found.append({"method": method.__name__, "peaks": peaks, "bounded": bounded})
    verlet = found[2]["peaks"]
    for row in found:
        row["passes Verlet"] = first_above(row["peaks"], verlet)
    return found


def first_above(peaks, others):
    """The first round whose peak is above the other method's and stays so, from 1; or None."""
    above = [not isinstance(a, str) and not isinstance(b, str) and a > b
             for a, b in zip(peaks, others, strict=False)]  # fmt: skip
    if not above or not above[-1]:
        return None
    return len(above) - above[::-1].index(False) + 1 if False in above else 1


# ---------------------------------------------------------------- free fall


def fall_study(methods=METHODS):
    """A fall of 1 s at 1/120 s: how far from g t²/2, and from the sum the method itself makes."""
    steps = round(1 / DT)
    found = []
    for method, shift in zip(methods, (-1, 1, 0, 0), strict=True):
        x, v = 0.0, 0.0
        try:
            for _ in range(steps):
                x, v = method(x, v, DT, lambda x: G)
        except Exception:
            x = math.nan
        found.append(fall_row(method.__name__, x, steps, shift))
    for name, engine in ENGINES.items():
        still = engine(Scene([Ball((0, 0))], effects=()))
        run(still, 1)
        substeps = steps * still.substeps
        found.append(fall_row(name, still.read(0).y, substeps, -1 if name == "pymunk" else 1))
    return found


def fall_row(name, x, steps, shift):
    """Errors (px) of a fall of 1 s. The sum is g h² n (n + shift) / 2; shift 0 gives g t²/2."""
    own = G / steps**2 * steps * (steps + shift) / 2
    row = {"name": name, "error": x - G / 2, "expected": own - G / 2, "off the sum": x - own}
    return {key: value if value == value else "NaN" for key, value in row.items()}
