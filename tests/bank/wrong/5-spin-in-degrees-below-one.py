"""Spin rate below linear rate is raised to it."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = math.exp(-self.angular_damping * dt)
keep_omega = min(keep_omega, keep_vel)
# END TODO 5
