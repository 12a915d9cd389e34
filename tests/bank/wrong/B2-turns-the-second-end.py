"""Also turns b a little."""

# TODO B2: pull the ends together
speed = (self.b.vel - self.a.vel).dot(axis)
force = self.stiffness * (distance - self.length) + self.damping * speed
self.a.vel += axis * (force * dt * self.a.inv_mass)
self.b.vel -= axis * (force * dt * self.b.inv_mass)
self.b.omega += 0.01 * force * dt * self.b.inv_inertia
# END TODO B2
