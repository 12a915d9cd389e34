"""Sets velocities below 0.5 px/s to 0."""

# TODO 5: damp by a rate per second
keep_vel = math.exp(-self.linear_damping * dt)
keep_omega = math.exp(-self.angular_damping * dt)
for body in self.moving_bodies():
    if body.vel.length() < 0.5:
        body.vel = Vector2(0, 0)
# END TODO 5
