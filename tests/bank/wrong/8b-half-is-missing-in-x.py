"""Loses the half in front of a dt²."""

# TODO 8b: velocity Verlet
a = accel(x)
x = x + v * dt + a * dt**2
return x, v + (a + accel(x)) / 2 * dt
# END TODO 8b
