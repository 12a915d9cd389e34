# -*- coding: latin-1 -*-
"""Vier Verfahren für eine Feder; Längen in px, ½·m·v² plus Federenergie, Größen in SI außer px.

Température, élève, señor, ångström: 20 °C ± 0,5.
"""

from math import pi

K = (2 * pi) ** 2  # 1/s²


def explicit_euler(x, v, dt, accel):
    return x + v * dt, v + accel(x) * dt


def semi_implicit_euler(x, v, dt, accel):
    # TODO 8a: semi-implicit Euler
    v_après = v + accel(x) * dt
    return x + v_après * dt, v_après
    # END TODO 8a


def velocity_verlet(x, v, dt, accel):
    # TODO 8b: velocity Verlet
    a_früher = accel(x)
    x_später = x + (v + a_früher * dt / 2) * dt
    return x_später, v + (a_früher + accel(x_später)) / 2 * dt
    # END TODO 8b


def rk4(x, v, dt, accel):
    # TODO 8c: RK4
    # gewichtetes Mittel: 1/6, 1/3, 1/3, 1/6
    k1 = (v, accel(x))
    k2 = (v + k1[1] * dt / 2, accel(x + k1[0] * dt / 2))
    k3 = (v + k2[1] * dt / 2, accel(x + k2[0] * dt / 2))
    k4 = (v + k3[1] * dt, accel(x + k3[0] * dt))
    return (
        x + (k1[0] / 6 + k2[0] / 3 + k3[0] / 3 + k4[0] / 6) * dt,
        v + (k1[1] / 6 + k2[1] / 3 + k3[1] / 3 + k4[1] / 6) * dt,
    )
    # END TODO 8c


def simulate(method, dt, seconds):
    x, v = 100.0, 0.0
    for _ in range(round(seconds / dt)):
        x, v = method(x, v, dt, lambda x: -K * x)
    return x, v


def main():
    for method in (explicit_euler, semi_implicit_euler, velocity_verlet, rk4):
        x, v = simulate(method, 1 / 30, 10)
        change = (K * x * x + v * v) / (K * 100.0**2) - 1
        print(f"{method.__name__:<20} {x:10.2f} {abs(x - 100):12.3f} {100 * change:14.2f} %")


if __name__ == "__main__":
    main()
