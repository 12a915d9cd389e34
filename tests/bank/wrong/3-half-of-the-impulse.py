"""Gives each end half of what it should get, as if the two shared it."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k / 2)
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
# END TODO 3
