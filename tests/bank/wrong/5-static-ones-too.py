"""Damps every body in a loop of its own: a static body that was given a velocity (a moving platform) slows down."""

# TODO 5: damp by a rate per second
keep_vel = keep_omega = 1.0
for body in self.bodies:
    body.vel *= math.exp(-self.linear_damping * dt)
    body.omega *= math.exp(-self.angular_damping * dt)
# END TODO 5
