"""Velocity Verlet for steps above 0.05 s."""

# TODO 8c: RK4
if dt > 0.05:
    return velocity_verlet(x, v, dt, accel)
v1, a1 = v, accel(x)
v2, a2 = v + 0.5 * dt * a1, accel(x + 0.5 * dt * v1)
v3, a3 = v + 0.5 * dt * a2, accel(x + 0.5 * dt * v2)
v4, a4 = v + dt * a3, accel(x + dt * v3)
return x + dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4), v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
# END TODO 8c
