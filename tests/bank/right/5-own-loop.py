"""Own loop in the region, keeps set to 1 for the given loop after it."""

# TODO 5: damp by a rate per second
for body in self.moving_bodies():
    body.vel = body.vel * math.exp(-dt * self.linear_damping)
    body.omega = body.omega * math.exp(-dt * self.angular_damping)
keep_vel = keep_omega = 1
# END TODO 5
