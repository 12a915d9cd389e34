"""A parabola, with one acceleration for the whole step."""

# TODO 8b: velocity Verlet
a = accel(x)
return x + v * dt + 0.5 * a * dt**2, v + a * dt
# END TODO 8b
