"""Moves first and uses the acceleration at the new place."""

# TODO 8a: semi-implicit Euler
x += v * dt
v += accel(x) * dt
return x, v
# END TODO 8a
