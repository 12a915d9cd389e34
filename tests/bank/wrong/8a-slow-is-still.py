"""Takes speeds below 0.1 px/s for 0."""

# TODO 8a: semi-implicit Euler
v = v + accel(x) * dt
if abs(v) < 0.1:
    v = 0.0
return x + v * dt, v
# END TODO 8a
