"""Uses 1/120 s whatever dt."""

# TODO B2: pull the ends together
speed = (self.b.vel - self.a.vel).dot(axis)
force = self.stiffness * (distance - self.length) + self.damping * speed
self.a.vel += axis * (force / 120 * self.a.inv_mass)
self.b.vel -= axis * (force / 120 * self.b.inv_mass)
# END TODO B2
