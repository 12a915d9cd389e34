"""Moves with the mean of the old and the new velocity."""

# TODO 8a: semi-implicit Euler
new_v = v + accel(x) * dt
return x + (v + new_v) / 2 * dt, new_v
# END TODO 8a
