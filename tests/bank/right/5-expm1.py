"""1 + expm1."""

# TODO 5: damp by a rate per second
keep_vel = 1 + math.expm1(-self.linear_damping * dt)
keep_omega = 1 + math.expm1(-dt * self.angular_damping)
# END TODO 5
