"""Computes one factor from linear_damping and uses it twice."""

# TODO 5: damp by a rate per second
keep_vel = keep_omega = math.exp(-self.linear_damping * dt)
# END TODO 5
