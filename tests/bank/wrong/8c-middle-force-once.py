"""Gets the third sample's acceleration from the slope: right for a linear force."""

# TODO 8c: RK4
v1, a1 = v, accel(x)
x2 = x + 0.5 * dt * v1
v2, a2 = v + 0.5 * dt * a1, accel(x2)
x3 = x + 0.5 * dt * v2
slope = (a2 - a1) / (x2 - x) if x2 != x else (accel(x + 1) - a1)
v3, a3 = v + 0.5 * dt * a2, a1 + slope * (x3 - x)
v4, a4 = v + dt * a3, accel(x + dt * v3)
return x + dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4), v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
# END TODO 8c
