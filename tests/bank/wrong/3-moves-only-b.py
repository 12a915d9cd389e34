"""Takes A for a fixed hook: only B feels the rod."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
self.b.vel += impulse * self.b.inv_mass
# END TODO 3
