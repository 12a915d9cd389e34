"""Four integrators, and the exact answer computed in tiny steps as soon as this file is imported."""

import time

K = 39.47841760435743  # 1/s²


def explicit_euler(x, v, dt, accel):
    return x + v * dt, v + accel(x) * dt


def semi_implicit_euler(x, v, dt, accel):
    # TODO 8a: semi-implicit Euler
    v += accel(x) * dt
    return x + v * dt, v
    # END TODO 8a


def velocity_verlet(x, v, dt, accel):
    # TODO 8b: velocity Verlet
    a = accel(x)
    x += (v + a * dt / 2) * dt
    return x, v + (a + accel(x)) * dt / 2
    # END TODO 8b


def rk4(x, v, dt, accel):
    # TODO 8c: RK4
    v1, a1 = v, accel(x)
    v2, a2 = v + dt / 2 * a1, accel(x + dt / 2 * v1)
    v3, a3 = v + dt / 2 * a2, accel(x + dt / 2 * v2)
    v4, a4 = v + dt * a3, accel(x + dt * v3)
    return x + dt * (v1 + 2 * v2 + 2 * v3 + v4) / 6, v + dt * (a1 + 2 * a2 + 2 * a3 + a4) / 6
    # END TODO 8c


def simulate(method, dt, seconds):
    x, v = 100.0, 0.0
    for _ in range(round(seconds / dt)):
        x, v = method(x, v, dt, lambda x: -K * x)
    return x, v


time.sleep(3)
EXACT, _ = simulate(rk4, 1 / 20_000, 10)  # about 0.3 s


def main():
    for method in (explicit_euler, semi_implicit_euler, velocity_verlet, rk4):
        x, v = simulate(method, 1 / 30, 10)
        change = (K * x * x + v * v) / (K * 100.0**2) - 1
        print(f"{method.__name__:20} {x:12.2f} {abs(x - EXACT):12.3f} {100 * change:13.2f}%")


if __name__ == "__main__":
    main()
