"""Half kicks for Verlet, loops for RK4, and a list instead of a pair."""

# TODO 8a: semi-implicit Euler
v += accel(x) * dt
x += v * dt
return [x, v]
# END TODO 8a

# TODO 8b: velocity Verlet
v += accel(x) * dt / 2
x += v * dt
v += accel(x) * dt / 2
return x, v
# END TODO 8b

# TODO 8c: RK4
slope = lambda x, v: (v, accel(x))
k = [slope(x, v)]
for share in (0.5, 0.5, 1):
    dx, dv = k[-1]
    k.append(slope(x + dx * share * dt, v + dv * share * dt))
weights = (1, 2, 2, 1)
return tuple(
    start + dt * sum(w * each[i] for w, each in zip(weights, k)) / sum(weights)
    for i, start in enumerate((x, v))
)
# END TODO 8c
