"""Right at 120 steps per second only."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping / 120)
keep_omega = math.exp(-self.angular_damping / 120)
# END TODO 5
