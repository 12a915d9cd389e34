from math import pi


def explicit_euler(x, v, dt, accel):
    return x + dt * v, v + dt * accel(x)


def semi_implicit_euler(x, v, dt, accel):
    v += dt * accel(x)
    x += dt * v
    return x, v


def velocity_verlet(x, v, dt, accel):
    a = accel(x)
    x += dt * (v + dt / 2 * a)
    v += dt * (a + accel(x)) / 2
    return x, v


def rk4(x, v, dt, accel):
    def f(y):
        return y[1], accel(y[0])

    def go(k, h):
        return x + h * k[0], v + h * k[1]

    k1 = f((x, v))
    k2 = f(go(k1, dt / 2))
    k3 = f(go(k2, dt / 2))
    k4 = f(go(k3, dt))
    return tuple(y + dt * (p + 2 * (q + r) + s) / 6 for y, p, q, r, s in zip((x, v), k1, k2, k3, k4))


def simulate(method, dt, seconds):
    x, v = 100.0, 0.0
    for _ in range(int(seconds / dt + 0.5)):
        x, v = method(x, v, dt, lambda x: -((2 * pi) ** 2) * x)
    return x, v


def main():
    print("method                x after 10 s   error (px)  energy change")
    for method in (explicit_euler, semi_implicit_euler, velocity_verlet, rk4):
        x, v = simulate(method, 1 / 30, 10)
        e = (v * v / (2 * pi) ** 2 + x * x) / 100**2 - 1
        print(f"{method.__name__:20}  {x:12.2f} {abs(x - 100):12.3f} {100 * e:13.2f}%")


if __name__ == "__main__":
    main()
