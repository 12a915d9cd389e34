"""Damps only when both rates are above 0."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = math.exp(-self.angular_damping * dt)
if not (self.linear_damping and self.angular_damping):
    keep_vel = keep_omega = 1.0
# END TODO 5
