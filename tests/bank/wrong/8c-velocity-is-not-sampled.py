"""Samples the acceleration four times but keeps one velocity."""

# TODO 8c: RK4
a1 = accel(x)
a2 = accel(x + dt / 2 * v)
a3 = accel(x + dt / 2 * v)
a4 = accel(x + dt * v)
return x + dt * v, v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
# END TODO 8c
