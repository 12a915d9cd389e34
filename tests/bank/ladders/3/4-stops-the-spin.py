"""Right but for the spin of B, which it stops."""

# TODO 3: hold the rod's length
speed = (self.b.vel - self.a.vel).dot(self.axis)
if self.k:
    impulse = self.axis * ((self.bias - speed) / self.k)
    self.a.vel -= impulse * self.a.inv_mass
    self.b.vel += impulse * self.b.inv_mass
    self.b.omega = 0.0
# END TODO 3
