"""A spring without damping."""

# TODO B2: pull the ends together
force = self.stiffness * (distance - self.length)
self.a.vel += axis * (force * dt * self.a.inv_mass)
self.b.vel -= axis * (force * dt * self.b.inv_mass)
# END TODO B2
