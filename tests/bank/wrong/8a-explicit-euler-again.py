"""Moves with the old velocity: explicit Euler in two lines."""

# TODO 8a: semi-implicit Euler
new_x = x + v * dt
new_v = v + accel(x) * dt
return new_x, new_v
# END TODO 8a
