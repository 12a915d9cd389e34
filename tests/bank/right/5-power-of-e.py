"""e to a power instead of exp, in two spellings."""

# TODO 5: damp by a rate per second
keep_vel = math.e ** (-self.linear_damping * dt)
keep_omega = pow(math.e, -dt * self.angular_damping)
# END TODO 5
