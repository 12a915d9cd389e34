"""Replaces rates above 1 by 1 in the world itself."""

# TODO 5: damp by a rate per second
self.linear_damping = min(self.linear_damping, 1.0)
self.angular_damping = min(self.angular_damping, 1.0)
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = math.exp(-self.angular_damping * dt)
# END TODO 5
