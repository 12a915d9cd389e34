"""Uses the implicit form 1 / (1 + rate * dt) from a book on solvers."""

# TODO 5: damp by a rate per second
keep_vel = 1 / (1 + self.linear_damping * dt)
keep_omega = 1 / (1 + self.angular_damping * dt)
# END TODO 5
