"""Halves dt for the samples and goes on with the half."""

# TODO 8c: RK4
dt = dt / 2
v1, a1 = v, accel(x)
v2, a2 = v + dt * a1, accel(x + dt * v1)
v3, a3 = v + dt * a2, accel(x + dt * v2)
v4, a4 = v + dt * a3, accel(x + dt * v3)
x = x + dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4)
v = v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
return x, v
# END TODO 8c
