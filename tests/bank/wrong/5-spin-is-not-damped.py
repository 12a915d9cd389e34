"""Damps the velocity only."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = 1.0
# END TODO 5
