"""Takes one sample, at the start."""

# TODO 8c: RK4
return x + dt * v, v + dt * accel(x)
# END TODO 8c
