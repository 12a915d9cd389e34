"""Writes explicit Euler once more."""

# TODO 8b: velocity Verlet
a = accel(x)
return x + v * dt, v + a * dt
# END TODO 8b
