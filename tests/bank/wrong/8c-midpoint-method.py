"""Stops after the second sample."""

# TODO 8c: RK4
v2 = v + dt / 2 * accel(x)
a2 = accel(x + dt / 2 * v)
return x + dt * v2, v + dt * a2
# END TODO 8c
