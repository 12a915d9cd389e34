"""Changes the velocity by half before the parabola, which then bends twice."""

# TODO 8b: velocity Verlet
a = accel(x)
v = v + a * dt / 2
x = x + v * dt + 0.5 * a * dt**2
return x, v + accel(x) * dt / 2
# END TODO 8b
