"""Four integrators on a spring whose exact motion is known."""

import math

OMEGA = 2 * math.pi  # rad/s, a period of 1 s
X0 = 100.0  # px
DT = 1 / 30  # s
SECONDS = 10


def spring(x):
    """Return the acceleration of the spring at x."""
    return -(OMEGA**2) * x


def explicit_euler(x, v, dt, accel):
    """Move with the old velocity."""
    return x + v * dt, v + accel(x) * dt


def semi_implicit_euler(x, v, dt, accel):
    """Update the velocity first and move with the new one."""
    v += accel(x) * dt
    x += v * dt
    return x, v


def velocity_verlet(x, v, dt, accel):
    """Average the acceleration at both ends of the step."""
    a0 = accel(x)
    x += v * dt + 0.5 * a0 * dt * dt
    v += 0.5 * (a0 + accel(x)) * dt
    return x, v


def rk4(x, v, dt, accel):
    """Average four samples of the slope."""
    k1x, k1v = v, accel(x)
    k2x, k2v = v + k1v * dt / 2, accel(x + k1x * dt / 2)
    k3x, k3v = v + k2v * dt / 2, accel(x + k2x * dt / 2)
    k4x, k4v = v + k3v * dt, accel(x + k3x * dt)
    x += dt / 6 * (k1x + 2 * k2x + 2 * k3x + k4x)
    v += dt / 6 * (k1v + 2 * k2v + 2 * k3v + k4v)
    return x, v


def simulate(method, dt, seconds):
    """Return (x, v) after some seconds."""
    x, v = X0, 0.0
    for _ in range(round(seconds / dt)):
        x, v = method(x, v, dt, spring)
    return x, v


def energy(x, v):
    """Return the energy per unit of mass."""
    return 0.5 * v * v + 0.5 * OMEGA**2 * x * x


if __name__ == "__main__":
    start = energy(X0, 0.0)
    for method in (explicit_euler, semi_implicit_euler, velocity_verlet, rk4):
        x, v = simulate(method, DT, SECONDS)
        change = 100 * (energy(x, v) - start) / start
        print(
            f"{method.__name__:20} x = {x:9.2f} px   error = {abs(x - X0):9.3f} px   "
            f"energy {change:+.2f}%"
        )
