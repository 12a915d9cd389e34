"""Asks for the acceleration at v instead of x."""

# TODO 8a: semi-implicit Euler
v = v + accel(v) * dt
return x + v * dt, v
# END TODO 8a
