"""Moves with the old velocity, then changes it."""

# TODO 8a: semi-implicit Euler
x = x + v * dt
return x, v + accel(x) * dt
# END TODO 8a
