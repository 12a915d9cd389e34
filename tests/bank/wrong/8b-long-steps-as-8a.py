"""Semi-implicit Euler for steps above 0.1 s."""

# TODO 8b: velocity Verlet
if dt > 0.1:
    return semi_implicit_euler(x, v, dt, accel)
a_start = accel(x)
x = x + v * dt + 0.5 * a_start * dt**2
a_end = accel(x)
return x, v + 0.5 * (a_start + a_end) * dt
# END TODO 8b
