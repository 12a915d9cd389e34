"""Adds the force itself to the velocities."""

# TODO B2: pull the ends together
speed = (self.b.vel - self.a.vel).dot(axis)
force = self.stiffness * (distance - self.length) + self.damping * speed
self.a.vel += axis * (force * self.a.inv_mass)
self.b.vel -= axis * (force * self.b.inv_mass)
# END TODO B2
