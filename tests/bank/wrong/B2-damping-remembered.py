"""Keeps the last speed and damps by the mean of both."""

# TODO B2: pull the ends together
speed = (self.b.vel - self.a.vel).dot(axis)
last = getattr(self, 'last_speed', speed)
self.last_speed = speed
speed = (speed + last) / 2
force = self.stiffness * (distance - self.length) + self.damping * speed
self.a.vel += axis * (force * dt * self.a.inv_mass)
self.b.vel -= axis * (force * dt * self.b.inv_mass)
# END TODO B2
