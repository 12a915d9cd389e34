"""Damps the spin only."""

# TODO 5: damp by a rate per second
keep_vel = 1.0
keep_omega = math.exp(-self.angular_damping * dt)
# END TODO 5
