"""Projects the relative velocity, and makes new vectors of the velocities."""

# TODO 3: hold the rod's length
if not self.k:
    return None
relative = (self.b.vel - self.a.vel).project(self.axis)
change = self.axis * self.bias - relative
impulse = change / self.k
self.a.vel, self.b.vel = self.a.vel - impulse * self.a.inv_mass, self.b.vel + impulse * self.b.inv_mass
# END TODO 3
