"""Samples in the middle of the step instead of at its ends."""

# TODO 8b: velocity Verlet
x_mid = x + v * dt / 2
v_mid = v + accel(x) * dt / 2
return x + v_mid * dt, v + accel(x_mid) * dt
# END TODO 8b
