"""Moves with the velocity alone, then uses the acceleration at the new place."""

# TODO 8b: velocity Verlet
x = x + v * dt
return x, v + accel(x) * dt
# END TODO 8b
