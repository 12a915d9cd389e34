"""Stiffness is lowered to the largest stable one in each step."""

# TODO B2: pull the ends together
speed = (self.b.vel - self.a.vel).dot(axis)
force = min(self.stiffness, 1 / (dt * dt * max(self.a.inv_mass + self.b.inv_mass, 1e-9))) * (distance - self.length) + self.damping * speed
self.a.vel += axis * (force * dt * self.a.inv_mass)
self.b.vel -= axis * (force * dt * self.b.inv_mass)
# END TODO B2
