"""As it should be."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = math.exp(-self.angular_damping * dt)
# END TODO 5
