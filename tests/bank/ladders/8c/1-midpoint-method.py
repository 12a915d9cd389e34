"""Two of the four samples."""

# TODO 8c: RK4
half = v + 0.5 * dt * accel(x)
return x + dt * half, v + dt * accel(x + 0.5 * dt * v)
# END TODO 8c
