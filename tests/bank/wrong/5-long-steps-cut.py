"""A step longer than 1/30 s damps as one of 1/30 s."""

# TODO 5: damp by a rate per second
dt = min(dt, 1 / 30)
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = math.exp(-self.angular_damping * dt)
# END TODO 5
