"""The acceleration at the mean place instead of the mean acceleration."""

# TODO 8b: velocity Verlet
a = accel(x)
end = x + v * dt + 0.5 * a * dt**2
return end, v + accel((x + end) / 2) * dt
# END TODO 8b
