"""Mixes up the share that is lost with the share that is kept."""

# TODO 5: damp by a rate per second
keep_vel = 1 - math.exp(-self.linear_damping * dt)
keep_omega = 1 - math.exp(-self.angular_damping * dt)
# END TODO 5
