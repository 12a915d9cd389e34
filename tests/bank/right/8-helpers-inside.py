"""Functions inside the functions, and new velocities found before the places."""

# TODO 8a: semi-implicit Euler
new_v = v + dt * accel(x)
new_x = x + dt * new_v
return (new_x, new_v)
# END TODO 8a

# TODO 8b: velocity Verlet
def parabola(start, speed, bend):
    return start + speed * dt + bend * dt * dt / 2


before = accel(x)
x = parabola(x, v, before)
after = accel(x)
return x, v + dt * before / 2 + dt * after / 2
# END TODO 8b

# TODO 8c: RK4
def sample(step, dx, dv):
    return v + step * dv, accel(x + step * dx)


half = dt / 2
first = sample(0, 0, 0)
second = sample(half, *first)
third = sample(half, *second)
fourth = sample(dt, *third)
mean = [(p + 2 * q + 2 * r + s) / 6 for p, q, r, s in zip(first, second, third, fourth)]
return x + mean[0] * dt, v + mean[1] * dt
# END TODO 8c
