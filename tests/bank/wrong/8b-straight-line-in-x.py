"""Moves along a straight line, without the acceleration."""

# TODO 8b: velocity Verlet
a = accel(x)
x = x + v * dt
return x, v + (a + accel(x)) / 2 * dt
# END TODO 8b
