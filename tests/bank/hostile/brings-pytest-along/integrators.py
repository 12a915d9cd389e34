"""All wrong."""

def explicit_euler(x, v, dt, accel):
    return x + v * dt, v + accel(x) * dt


def semi_implicit_euler(x, v, dt, accel):
    return 0.0, 0.0


velocity_verlet = rk4 = semi_implicit_euler


def simulate(method, dt, seconds):
    return 0.0, 0.0


def main():
    pass
