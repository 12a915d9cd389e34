"""Near enough for short steps and low rates."""

# TODO 5: damp by a rate per second
keep_vel = max(0.0, 1 - self.linear_damping * dt)
keep_omega = max(0.0, 1 - self.angular_damping * dt)
# END TODO 5
