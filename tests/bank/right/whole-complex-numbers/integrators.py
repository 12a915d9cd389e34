"""Integrators on complex states z = x + v j."""

import math

OMEGA = 2 * math.pi


def flow(z, accel):
    return complex(z.imag, accel(z.real))


def pair(z):
    return z.real, z.imag


def explicit_euler(x, v, dt, accel):
    z = complex(x, v)
    return pair(z + dt * flow(z, accel))


def semi_implicit_euler(x, v, dt, accel):
    z = complex(x, v)
    z += 1j * dt * accel(z.real)
    z += dt * z.imag
    return pair(z)


def velocity_verlet(x, v, dt, accel):
    z = complex(x, v)
    z += 0.5j * dt * accel(z.real)
    z += dt * z.imag
    z += 0.5j * dt * accel(z.real)
    return pair(z)


def rk4(x, v, dt, accel):
    z = complex(x, v)
    k, total = 0j, 0j
    for share, weight in ((0, 1), (0.5, 2), (0.5, 2), (1, 1)):
        k = flow(z + share * dt * k, accel)
        total += weight * k
    return pair(z + dt / 6 * total)


def spring(x):
    return -(OMEGA**2) * x


def simulate(method, dt, seconds):
    x, v = 100.0, 0.0
    for _ in range(round(seconds / dt)):
        x, v = method(x, v, dt, spring)
    return x, v


def main():
    print(f"{'method':<20} {'x after 10 s':>12} {'error (px)':>12} {'energy change':>14}")
    for method in (explicit_euler, semi_implicit_euler, velocity_verlet, rk4):
        x, v = simulate(method, 1 / 30, 10)
        energy = abs(complex(x, v / OMEGA)) ** 2 / 100**2
        change = f"{100 * (energy - 1):.2f}%"
        print(f"{method.__name__:<20} {x:>12.2f} {abs(x - 100):>12.3f} {change:>14}")


if __name__ == "__main__":
    main()
