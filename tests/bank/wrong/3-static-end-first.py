"""Takes the first end for the static one."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
if self.a.is_static or self.b.is_static:
    free = self.b if self.a.is_static else self.a
    free.vel += impulse * free.inv_mass
else:
    self.a.vel -= impulse * self.a.inv_mass
    self.b.vel += impulse * self.b.inv_mass
# END TODO 3
