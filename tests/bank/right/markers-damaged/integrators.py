"""Four integrators; the markers have seen better days."""


def explicit_euler(x, v, dt, accel):
    return x + v * dt, v + accel(x) * dt


# TODO 8a: semi-implicit Euler
def semi_implicit_euler(x, v, dt, accel):
    v += accel(x) * dt
    return x + v * dt, v


# TODO 8b: velocity Verlet
def velocity_verlet(x, v, dt, accel):
    a = accel(x)
    x += v * dt + a * dt**2 / 2
    return x, v + (a + accel(x)) / 2 * dt
# END TODO 8a


def rk4(x, v, dt, accel):
    # todo 8c  (done!!)
    v1, a1 = v, accel(x)
    v2, a2 = v + dt / 2 * a1, accel(x + dt / 2 * v1)
    v3, a3 = v + dt / 2 * a2, accel(x + dt / 2 * v2)
    v4, a4 = v + dt * a3, accel(x + dt * v3)
    return x + dt * (v1 + 2 * (v2 + v3) + v4) / 6, v + dt * (a1 + 2 * (a2 + a3) + a4) / 6
    # END OF TODO 8c


def simulate(method, dt, seconds):
    x, v = 100.0, 0.0
    for _ in range(round(seconds / dt)):
        x, v = method(x, v, dt, lambda x: -39.47841760435743 * x)
    return x, v


def main():
    for method in explicit_euler, semi_implicit_euler, velocity_verlet, rk4:
        x, v = simulate(method, 1 / 30, 10)
        change = (39.47841760435743 * x * x + v * v) / 394784.1760435743 - 1
        print(f"{method.__name__:20} {x:12.2f} {abs(x - 100):12.3f} {100 * change:13.2f}%")


if __name__ == "__main__":
    main()
