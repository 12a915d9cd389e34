"""The speeds of the samples are put into the formula: RK4 by accelerations only."""

# TODO 8c: RK4
h = dt
a1 = accel(x)
a2 = accel(x + h / 2 * v)
a3 = accel(x + h / 2 * v + h * h / 4 * a1)
a4 = accel(x + h * v + h * h / 2 * a2)
return x + h * v + h * h / 6 * (a1 + a2 + a3), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
# END TODO 8c
