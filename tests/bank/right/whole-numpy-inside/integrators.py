"""Integrators with numpy states."""

import numpy as np

OMEGA = 2 * np.pi


def slope(y, accel):
    return np.array([y[1], accel(y[0])])


def explicit_euler(x, v, dt, accel):
    y = np.array([x, v], float)
    return tuple(y + dt * slope(y, accel))


def semi_implicit_euler(x, v, dt, accel):
    v = v + dt * accel(x)
    return x + dt * v, v


def velocity_verlet(x, v, dt, accel):
    half = v + accel(x) * dt / 2
    x = x + half * dt
    return x, half + accel(x) * dt / 2


def rk4(x, v, dt, accel):
    y = np.array([x, v], float)
    ks = []
    for share in (0, 0.5, 0.5, 1):
        at = y + share * dt * ks[-1] if ks else y
        ks.append(slope(at, accel))
    y = y + dt * np.average(ks, axis=0, weights=(1, 2, 2, 1))
    return y[0], y[1]


def simulate(method, dt, seconds):
    x, v = 100.0, 0.0
    for _ in np.arange(round(seconds / dt)):
        x, v = method(x, v, dt, lambda x: -(OMEGA**2) * x)
    return x, v


def main():
    start = 0.5 * OMEGA**2 * 100.0**2
    print(f"{'method':<20} {'x after 10 s':>12} {'error (px)':>12} {'energy change':>14}")
    for method in (explicit_euler, semi_implicit_euler, velocity_verlet, rk4):
        x, v = simulate(method, 1 / 30, 10)
        change = f"{((v**2 + OMEGA**2 * x**2) / 2 / start - 1) * 100:.2f}%"
        print(f"{method.__name__:<20} {x:>12.2f} {np.abs(x - 100):>12.3f} {change:>14}")


if __name__ == "__main__":
    main()
