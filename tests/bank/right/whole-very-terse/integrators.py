"""Four integrators on a spring."""
from math import pi
W = 2 * pi


def explicit_euler(x, v, dt, accel): return x + v * dt, v + accel(x) * dt


def semi_implicit_euler(x, v, dt, accel): return x + (w := v + accel(x) * dt) * dt, w


def velocity_verlet(x, v, dt, accel):
    a = accel(x)
    y = x + v * dt + a * dt * dt / 2
    return y, v + (a + accel(y)) * dt / 2


def rk4(x, v, dt, accel):
    f = lambda z, k, h: (z[1] + k[1] * h, accel(z[0] + k[0] * h))
    z = x, v
    a = f(z, (0, 0), 0); b = f(z, a, dt / 2); c = f(z, b, dt / 2); d = f(z, c, dt)
    return tuple(s + dt / 6 * (p + 2 * q + 2 * r + t) for s, p, q, r, t in zip(z, a, b, c, d))


def simulate(method, dt, seconds):
    z = 100.0, 0.0
    for _ in range(round(seconds / dt)): z = method(*z, dt, lambda x: -W * W * x)
    return z


def main():
    e = lambda x, v: v * v + W * W * x * x
    print(f"{'method':<20} {'x after 10 s':>12} {'error (px)':>12} {'energy change':>14}")
    for m in explicit_euler, semi_implicit_euler, velocity_verlet, rk4:
        x, v = simulate(m, 1 / 30, 10)
        print(f"{m.__name__:<20} {x:>12.2f} {abs(x - 100):>12.3f} {100 * (e(x, v) / e(100, 0) - 1):>13.2f}%")


if __name__ == "__main__": main()
