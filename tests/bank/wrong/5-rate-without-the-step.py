"""Forgets dt: a whole second's loss in every step."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping)
keep_omega = math.exp(-self.angular_damping)
# END TODO 5
