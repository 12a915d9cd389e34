"""The kit's six checks of TODO 8, for graders that run them beside the submission."""

import math
import random

EXAMPLES = 25  # as many as the kit's property checks draw
OMEGA = 2 * math.pi  # rad/s
X0 = 100.0  # px


def exact_step(name, x, v, dt, accel):
    """Return the right (x, v) after one step."""
    if name == "semi_implicit_euler":
        v = v + accel(x) * dt
        return x + v * dt, v
    if name == "velocity_verlet":
        end = x + v * dt + accel(x) * dt**2 / 2
        return end, v + (accel(x) + accel(end)) * dt / 2
    v1, a1 = v, accel(x)
    v2, a2 = v + dt / 2 * a1, accel(x + dt / 2 * v1)
    v3, a3 = v + dt / 2 * a2, accel(x + dt / 2 * v2)
    v4, a4 = v + dt * a3, accel(x + dt * v3)
    return x + dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4), v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


def want_steps(name, method):
    """Check one step under any force."""
    rng = random.Random(8)
    for _ in range(EXAMPLES):
        x, v, *force = (rng.randint(-32, 32) / 8 for _ in range(6))
        dt = rng.choice([1 / 2, 1 / 4, 1 / 8, 1 / 16])

        def accel(x, force=tuple(force)):
            return force[0] + force[1] * x + force[2] * x**2 + force[3] * x**3

        right, answer = exact_step(name, x, v, dt, accel), method(x, v, dt, accel)
        for a, b in zip(answer, right, strict=True):
            assert math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9), f"{answer}, but it is {right}"


def swing(method, steps, seconds):
    """Return the state of the spring's body after so many steps; it is released at X0."""
    x, v = X0, 0.0
    for _ in range(steps):
        x, v = method(x, v, seconds / steps, lambda x: -(OMEGA**2) * x)
    return x, v


def want_spring(method, order, error, energy_change):
    """Check that half the step divides the error by 2^order, and the lesson's table."""
    exact_x = X0 * math.cos(OMEGA * 0.65)
    coarse, fine = (abs(swing(method, steps, 0.65)[0] - exact_x) for steps in (26, 52))
    ratio = 2**order
    assert ratio / math.sqrt(2) * fine < coarse < ratio * math.sqrt(2) * fine, (coarse, fine)
    x, v = swing(method, 300, 10.0)
    change = 100 * ((v**2 + OMEGA**2 * x**2) / (OMEGA**2 * X0**2) - 1)
    assert abs(abs(x - X0) - error) <= 0.0005 and abs(change - energy_change) <= 0.005, (x, change)
