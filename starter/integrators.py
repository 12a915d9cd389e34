"""Four integrators on a spring.

Each takes a position x (px), a velocity v (px/s), a time step dt (s) and a function accel(x)
(px/s²), and returns the new (x, v). Run this file to compare them.
"""

import math

OMEGA = 2 * math.pi  # rad/s: the spring swings once per second
X0 = 100.0  # px
DT = 1 / 30  # s
SECONDS = 10  # s, whole periods: exact x is X0 again


def explicit_euler(x, v, dt, accel):
    """Move with the old velocity, then change it."""
    return x + v * dt, v + accel(x) * dt


def semi_implicit_euler(x, v, dt, accel):
    """Change the velocity first, then move with the new one."""
    # TODO 8a: semi-implicit Euler
    # Replace this line.
    return explicit_euler(x, v, dt, accel)
    # END TODO 8a


def velocity_verlet(x, v, dt, accel):
    """Move along a parabola, then use the mean of the accelerations at both ends."""
    # TODO 8b: velocity Verlet
    # Replace this line.
    return explicit_euler(x, v, dt, accel)
    # END TODO 8b


def rk4(x, v, dt, accel):
    """Take four samples of (velocity, acceleration): start, middle twice, end.

    Each sample starts from x and v, moved by the one before; the means weigh them 1, 2, 2, 1
    (the classical Runge-Kutta method).
    """
    # TODO 8c: RK4
    # Replace this line.
    return explicit_euler(x, v, dt, accel)
    # END TODO 8c


def spring(x):
    """Return the acceleration (px/s²) of a spring that pulls back to x = 0."""
    return -(OMEGA**2) * x


def energy(x, v):
    """Return the energy per unit of mass (px²/s²) of the spring's body."""
    return 0.5 * v**2 + 0.5 * OMEGA**2 * x**2


def simulate(method, dt, seconds):
    """Let the spring go at X0 and return (x, v) after seconds, in steps of dt."""
    if not 0 < dt < math.inf:
        raise ValueError(f"dt is {dt}, but it must be a finite number of seconds above 0.")
    x, v = X0, 0.0
    for _ in range(round(seconds / dt)):
        x, v = method(x, v, dt, spring)
    return x, v


def main():
    """Print how far each method is from the exact answer."""
    print(f"{'method':<20} {'x after 10 s':>12} {'error (px)':>12} {'energy change':>14}")
    for method in (explicit_euler, semi_implicit_euler, velocity_verlet, rk4):
        x, v = simulate(method, DT, SECONDS)
        change = f"{100 * (energy(x, v) / energy(X0, 0.0) - 1):.2f}%"
        print(f"{method.__name__:<20} {x:>12.2f} {abs(x - X0):>12.3f} {change:>14}")


if __name__ == "__main__":
    main()
