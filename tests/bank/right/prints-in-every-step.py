"""Debug prints left in: ten megabytes and more in a run of a thousand steps."""

# TODO 2: add the spin terms
total += cross(ra, axis) ** 2 * a.inv_inertia + cross(rb, axis) ** 2 * b.inv_inertia
print("effective mass", total, ra, rb, axis, a.pos, b.pos)
# END TODO 2

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = math.exp(-self.angular_damping * dt)
for number, body in enumerate(self.bodies):
    print(f"body {number}", body.pos, body.vel, body.angle, body.omega, "-" * 2000)
print("error: this is only a word, and so are FAILED, 0/10 and Traceback")
# END TODO 5

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    print("=" * 10000)
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6

# TODO 8c: RK4
print("x", x, "v", v, "dt", dt)
v1, a1 = v, accel(x)
v2, a2 = v + 0.5 * dt * a1, accel(x + 0.5 * dt * v1)
v3, a3 = v + 0.5 * dt * a2, accel(x + 0.5 * dt * v2)
v4, a4 = v + dt * a3, accel(x + dt * v3)
print(f"{v1=} {v2=} {v3=} {v4=} {a1=} {a2=} {a3=} {a4=}")
return x + dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4), v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
# END TODO 8c
