"""Writes semi-implicit Euler once more."""

# TODO 8b: velocity Verlet
v = v + accel(x) * dt
return x + v * dt, v
# END TODO 8b
