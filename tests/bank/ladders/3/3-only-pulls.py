"""Pulls like a rope."""

# TODO 3: hold the rod's length
speed = (self.b.vel - self.a.vel).dot(self.axis)
if self.k and speed > self.bias:
    impulse = self.axis * ((self.bias - speed) / self.k)
    self.a.vel -= impulse * self.a.inv_mass
    self.b.vel += impulse * self.b.inv_mass
# END TODO 3
