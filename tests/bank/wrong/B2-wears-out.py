"""The length at rest grows by 1 % of a stretch above half of it."""

# TODO B2: pull the ends together
speed = (self.b.vel - self.a.vel).dot(axis)
force = self.stiffness * (distance - self.length) + self.damping * speed
self.a.vel += axis * (force * dt * self.a.inv_mass)
self.b.vel -= axis * (force * dt * self.b.inv_mass)
if distance > 1.5 * self.length:
    self.length += 0.01 * (distance - self.length)
# END TODO B2
