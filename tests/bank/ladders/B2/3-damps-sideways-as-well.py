"""Damps the speed across the spring, too."""

# TODO B2: pull the ends together
speed = self.b.vel - self.a.vel
force = axis * (self.stiffness * (distance - self.length)) + speed * self.damping
self.a.vel += force * (dt * self.a.inv_mass)
self.b.vel -= force * (dt * self.b.inv_mass)
# END TODO B2
