"""The 3/8 rule, another method of order 4: weights 1, 3, 3, 1."""

# TODO 8c: RK4
v1, a1 = v, accel(x)
v2, a2 = v + dt * a1 / 3, accel(x + dt * v1 / 3)
v3, a3 = v + dt * (a2 - a1 / 3), accel(x + dt * (v2 - v1 / 3))
v4, a4 = v + dt * (a1 - a2 + a3), accel(x + dt * (v1 - v2 + v3))
return x + dt / 8 * (v1 + 3 * v2 + 3 * v3 + v4), v + dt / 8 * (a1 + 3 * a2 + 3 * a3 + a4)
# END TODO 8c
