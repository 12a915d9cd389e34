"""Stops the speed along the rod but never wins back the length that was lost."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * (-speed / self.k)
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
# END TODO 3
