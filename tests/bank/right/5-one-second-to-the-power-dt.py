"""What a second keeps, to the power of the step; and one over what it would grow by."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping) ** dt
keep_omega = 1 / math.exp(self.angular_damping * dt)
# END TODO 5
