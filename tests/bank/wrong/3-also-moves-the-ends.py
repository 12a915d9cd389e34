"""Moves an end by a share of the error, besides pushing both."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
error = (self.b.pos - self.a.pos).length() - self.length
if abs(error) > 1:
    self.b.pos -= self.axis * (0.05 * error * self.b.inv_mass / self.k)
# END TODO 3
