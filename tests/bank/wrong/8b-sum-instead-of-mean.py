"""Adds both accelerations and forgets to halve."""

# TODO 8b: velocity Verlet
a = accel(x)
x = x + v * dt + 0.5 * a * dt**2
return x, v + (a + accel(x)) * dt
# END TODO 8b
