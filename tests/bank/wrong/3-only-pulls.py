"""Treats the rod as a rope: it never pushes the two apart."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
push = min(0, (self.bias - speed) / self.k)
impulse = self.axis * push
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
# END TODO 3
