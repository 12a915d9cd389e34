"""Uses 1 - rate * dt, which is close for short steps only."""

# TODO 5: damp by a rate per second
keep_vel = 1 - self.linear_damping * dt
keep_omega = 1 - self.angular_damping * dt
# END TODO 5
