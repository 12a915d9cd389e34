"""Changes the velocity by the acceleration at the new place alone."""

# TODO 8b: velocity Verlet
x = x + v * dt + 0.5 * accel(x) * dt**2
return x, v + accel(x) * dt
# END TODO 8b
