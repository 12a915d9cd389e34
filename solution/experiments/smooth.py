"""The four integrators of integrators.py where the exact answer is known: error against cost.

Every system here is smooth: no contacts. Each is run at many step sizes; the error is how far the
end is from the exact one, and the cost is how often the acceleration had to be worked out. One
that was just worked out is kept: Verlet ends each step where the next one begins.
"""

import math
from dataclasses import dataclass
from statistics import linear_regression

import integrators

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

    Positions may be complex numbers, x + iy: the methods only add and multiply.
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


def make_spring():
    """Return a weight on a spring of 1 Hz, stopped off-phase: after whole periods errors cancel."""
    omega, seconds = integrators.OMEGA, 9.75
    start = (integrators.X0, 0.0)
    end = (
        integrators.X0 * math.cos(omega * seconds),
        -integrators.X0 * omega * math.sin(omega * seconds),
    )
    size, accel, halvings = integrators.X0, integrators.spring, ((2, 11), (0, 8), (0, 8), (0, 8))
    orders = (1, 1, 2, 4)
    return System("spring", "px", start, end, seconds, accel, size, omega, orders, 156, halvings)


def make_orbit():
    """Return a planet on an ellipse (e = 0.5, half axis 100 px, 1 s per round), for 10 rounds.

    It starts nearest to the sun. There a semi-implicit step is a Verlet step seen half a kick
    later, so after whole rounds its error shrinks with the square of the step.
    """
    half_axis, e, omega = 100.0, 0.5, 2 * math.pi
    pull = omega**2 * half_axis**3  # px³/s²
    start = (complex(half_axis * (1 - e)), 1j * omega * half_axis * math.sqrt((1 + e) / (1 - e)))

    def accel(x):
        return -pull * x / abs(x) ** 3

    halvings, orders = ((2, 5), (0, 7), (0, 7), (0, 6)), (1, 2, 2, 4)
    return System("orbit", "px", start, start, 10.0, accel, 150.0, omega, orders, 1280, halvings)


SYSTEMS = (make_spring, make_orbit)


def study_system(system, methods=METHODS, most=math.inf):
    """Run each method at step sizes that halve, and measure its order. Runs have most steps."""
    found = []
    for method, expected, (first, last) in zip(
        methods, system.orders, system.halvings, strict=True
    ):
        counts = [system.steps * 2**k for k in range(first, last + 1)]
        points = [measure_run(system, method, steps) for steps in counts if steps <= most]
        order = measure_order(points, system.size)
        found.append(
            {"method": method.__name__, "expected": expected, "order": order, "points": points}
        )
    about = {"title": system.title, "unit": system.unit, "size": system.size}
    return {**about, "methods": found}


class Remembered:
    """An acceleration that remembers its last answer, and counts how often it worked one out."""

    def __init__(self, accel):
        self.accel, self.calls, self.x, self.answer = accel, 0, None, None

    def __call__(self, x):
        if x != self.x:
            self.calls += 1
            self.x, self.answer = x, self.accel(x)
        return self.answer


def measure_run(system, method, steps):
    """Run a method. Return its step (s), its calls of accel, and its error or what failed."""
    accel = Remembered(system.accel)
    dt = system.seconds / steps
    x, v = system.start
    try:
        for _ in range(steps):
            x, v = method(x, v, dt, accel)
        error = measure_distance(system, x, v)
        error = error if math.isfinite(error) else "blown up"
    except ArithmeticError:
        error = "blown up"
    except Exception as problem:  # the method is a student's
        error = type(problem).__name__
    return {"dt": dt, "calls": accel.calls, "error": error}


def measure_distance(system, x, v):
    """Return how far a position and a velocity are from the exact ones, in the system's unit."""
    return math.hypot(abs(x - system.end[0]), abs(v - system.end[1]) / system.rate)


def measure_order(points, size):
    """Return the slope of log error over log step where errors are small but not rounding."""
    low, high = ROUNDING * size, SETTLED * size
    kept = [p for p in points if not isinstance(p["error"], str) and low < p["error"] < high]
    if len(kept) < FINEST:
        return None
    steps, errors = ([math.log(p[key]) for p in kept[-FINEST:]] for key in ("dt", "error"))
    return linear_regression(steps, errors).slope


ENERGY_ROUNDS, ENERGY_CALLS = 300, 400  # rounds of the orbit, and evaluations in each
CALLS = {"rk4": 4}  # evaluations in a step, where they are more than 1


def find_energy_peaks(method, rounds=ENERGY_ROUNDS):
    """Return the largest relative energy error of each round, at equal evaluations."""
    steps = ENERGY_CALLS // CALLS.get(method.__name__, 1)
    system = make_orbit()
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


def study_energy(methods=METHODS):
    """Measure whether the energy error of an orbit stays bounded: no larger in the last round."""
    found = []
    for method in methods:
        peaks = find_energy_peaks(method)
        whole = not isinstance(peaks[-1], str)
        growth = peaks[-1] / peaks[0] if whole and peaks[0] else None
        bounded = growth is not None and growth < 1.5
        found.append({"method": method.__name__, "peaks": peaks, "bounded": bounded})
    return found
