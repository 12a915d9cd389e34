"""Error against cost of the four integrators of integrators.py, where exact answers are known.

A spring is run at many step sizes. The error is its largest distance from the exact position in its
last swing; at the very end of a swing, errors cancel. The cost is the number of accelerations. The
latest one is reused: Verlet ends each step where the next begins. An orbit shows whether the energy
error stays bounded.
"""

import math
from statistics import linear_regression

import integrators
from integrators import explicit_euler, rk4, semi_implicit_euler, velocity_verlet

METHODS = (explicit_euler, semi_implicit_euler, velocity_verlet, rk4)
SETTLED = 0.05  # an error below this share of the swing follows the method's order
ROUNDING = 2e-12  # below this share, rounding of the numbers hides the method's error
FINEST = 3  # points with errors in between, the finest ones, from which the order is measured
SWINGS = 10  # of the spring, each of 1 s
STEPS = 160  # of the coarsest run
HALVINGS = ((2, 11), (0, 8), (0, 8), (0, 8))  # of the step: the first and the last for each method
ORDERS = (1, 1, 2, 4)  # expected


def study_spring(methods=METHODS, most=math.inf):
    """Run each method at steps that halve, and measure its order. Runs have most steps."""
    found = []
    for method, expected, (first, last) in zip(methods, ORDERS, HALVINGS, strict=True):
        counts = [STEPS * 2**k for k in range(first, last + 1)]
        points = [measure_run(method, steps) for steps in counts if steps <= most]
        row = {"method": method.__name__, "expected": expected, "order": measure_order(points)}
        found.append({**row, "points": points})
    return found


class Remembered:
    """An acceleration that reuses its last answer, and counts the others."""

    def __init__(self, accel):
        self.accel, self.calls, self.x, self.answer = accel, 0, None, None

    def __call__(self, x):
        if x != self.x:
            self.calls += 1
            self.x, self.answer = x, self.accel(x)
        return self.answer


def measure_run(method, steps):
    """Run a spring. Return the step (s), the calls of accel, and the error (px) or what failed."""
    accel = Remembered(integrators.spring)
    dt = SWINGS / steps
    x, v, error = integrators.X0, 0.0, 0.0
    try:
        for step in range(1, steps + 1):
            x, v = method(x, v, dt, accel)
            if step * dt > SWINGS - 1:
                error = max(error, measure_distance(x, v, step * dt))
        error = error if math.isfinite(x) else "blown up"
    except ArithmeticError:
        error = "blown up"
    except Exception as problem:  # the method is a student's
        error = type(problem).__name__
    return {"dt": dt, "calls": accel.calls, "error": error}


def measure_distance(x, v, seconds):
    """Return the distance (px) of a position and a velocity from the spring's exact ones."""
    turn = integrators.OMEGA * seconds
    miss = x - integrators.X0 * math.cos(turn)
    return math.hypot(miss, v / integrators.OMEGA + integrators.X0 * math.sin(turn))


def measure_order(points):
    """Return the slope of log error over log step where errors are small but not rounding."""
    low, high = ROUNDING * integrators.X0, SETTLED * integrators.X0
    kept = [p for p in points if not isinstance(p["error"], str) and low < p["error"] < high]
    if len(kept) < FINEST:
        return None
    steps, errors = ([math.log(p[key]) for p in kept[-FINEST:]] for key in ("dt", "error"))
    return linear_regression(steps, errors).slope


ORBIT_PULL = (2 * math.pi) ** 2 * 100.0**3  # px³/s²: half axis 100 px, 1 s a round
NEAREST, FASTEST = 50.0, 2 * math.pi * 100.0 * math.sqrt(3)  # px, px/s: e = 0.5
ENERGY_ROUNDS, ENERGY_CALLS = 300, 400  # rounds of the orbit, and evaluations in each
CALLS = {"rk4": 4}  # evaluations in a step, if more than 1


def find_energy_peaks(method, rounds=ENERGY_ROUNDS):
    """Return the largest relative energy error of each round, at equal evaluations."""
    steps = ENERGY_CALLS // CALLS.get(method.__name__, 1)

    def accel(x):
        return -ORBIT_PULL * x / abs(x) ** 3

    def energy(x, v):
        return abs(v) ** 2 / 2 - ORBIT_PULL / abs(x)

    x, v = complex(NEAREST), 1j * FASTEST  # the methods only add and multiply
    start, peaks = energy(x, v), []
    try:
        for _ in range(rounds):
            peak = 0.0
            for _ in range(steps):
                x, v = method(x, v, 1 / steps, accel)
                peak = max(peak, abs(energy(x, v) / start - 1))
            peaks.append(peak)
    except Exception as problem:
        peaks.append(type(problem).__name__)
    return peaks


def study_energy(methods=METHODS):
    """Measure whether the energy error of an orbit is no larger in the last round."""
    found = []
    for method in methods:
        peaks = find_energy_peaks(method)
        first, last = peaks[0], peaks[-1]
        bounded = not isinstance(last, str) and first > 0 and last / first < 1.5
        found.append({"method": method.__name__, "peaks": peaks, "bounded": bounded})
    return found
