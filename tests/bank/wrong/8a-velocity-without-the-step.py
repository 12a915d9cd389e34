"""Adds the whole acceleration, whatever the step."""

# TODO 8a: semi-implicit Euler
v = v + accel(x)
return x + v * dt, v
# END TODO 8a
