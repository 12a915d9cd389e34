"""Right on the spring: the acceleration at the mean place."""

# TODO 8b: velocity Verlet
end = x + v * dt + 0.5 * accel(x) * dt**2
return end, v + accel((x + end) / 2) * dt
# END TODO 8b
