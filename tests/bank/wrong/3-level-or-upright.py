"""Takes a rod that is nearly level or upright for one that is."""

# TODO 3: hold the rod's length
if abs(self.axis.x) < 0.05 or abs(self.axis.y) < 0.05:
    self.axis = Vector2(round(self.axis.x), round(self.axis.y))
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
# END TODO 3
