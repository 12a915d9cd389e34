"""The mean of both accelerations."""

# TODO 8b: velocity Verlet
a_start = accel(x)
x = x + v * dt + 0.5 * a_start * dt**2
return x, v + 0.5 * (a_start + accel(x)) * dt
# END TODO 8b
