"""Lets the length creep after the distance."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
now = (self.b.pos - self.a.pos).length()
if now > self.length:
    self.length += 0.01 * (now - self.length)
# END TODO 3
