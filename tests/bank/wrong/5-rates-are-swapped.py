"""Gives the spin the rate of the velocity and the other way round."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.angular_damping * dt)
keep_omega = math.exp(-self.linear_damping * dt)
# END TODO 5
