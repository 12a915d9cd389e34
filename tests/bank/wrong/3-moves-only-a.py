"""Forgets the second body: only A feels the rod."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
self.a.vel -= impulse * self.a.inv_mass
# END TODO 3
