"""Brakes the whole velocity of one end as seen from the other."""

# TODO B2: pull the ends together
speed = self.b.vel - self.a.vel
force = axis * (self.stiffness * (distance - self.length)) + speed * self.damping
self.a.vel += force * (dt * self.a.inv_mass)
self.b.vel -= force * (dt * self.b.inv_mass)
# END TODO B2
