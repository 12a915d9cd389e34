"""Unpacked comprehension."""

# TODO 5: damp by a rate per second
keep_vel, keep_omega = (math.exp(-rate * dt) for rate in (self.linear_damping, self.angular_damping))
# END TODO 5
