"""Multiplies the world's gravity with the share as well, for a limit speed."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = math.exp(-self.angular_damping * dt)
self.gravity *= keep_vel
# END TODO 5
