"""The velocity first, then the place."""

# TODO 8a: semi-implicit Euler
v = v + accel(x) * dt
return x + v * dt, v
# END TODO 8a
