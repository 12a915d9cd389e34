"""Keeps the first sample for the next call with the same speed and step."""

# TODO 8c: RK4
key = v, dt
last_key, a1 = getattr(rk4, "last", (None, 0.0))
if key != last_key:
    a1 = accel(x)
rk4.last = key, a1
v1 = v
v2, a2 = v + 0.5 * dt * a1, accel(x + 0.5 * dt * v1)
v3, a3 = v + 0.5 * dt * a2, accel(x + 0.5 * dt * v2)
v4, a4 = v + dt * a3, accel(x + dt * v3)
return x + dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4), v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
# END TODO 8c
