"""Takes the plain mean of the four samples."""

# TODO 8c: RK4
v1, a1 = v, accel(x)
v2, a2 = v + dt / 2 * a1, accel(x + dt / 2 * v1)
v3, a3 = v + dt / 2 * a2, accel(x + dt / 2 * v2)
v4, a4 = v + dt * a3, accel(x + dt * v3)
return x + dt * (v1 + v2 + v3 + v4) / 4, v + dt * (a1 + a2 + a3 + a4) / 4
# END TODO 8c
