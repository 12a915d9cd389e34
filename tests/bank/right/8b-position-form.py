"""Verlet's own form, with the place before."""

# TODO 8b: velocity Verlet
a0 = accel(x)
x_previous = x - v * dt + 0.5 * a0 * dt**2
x_next = 2 * x - x_previous + a0 * dt**2
a1 = accel(x_next)
return x_next, v + (a0 + a1) * 0.5 * dt
# END TODO 8b
