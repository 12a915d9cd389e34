"""Measures the axis itself, by the places, and has none where both ends are in one."""

# TODO 3: hold the rod's length
if self.k > 0:
    axis = (self.b.pos - self.a.pos).normalize()
    impulse = axis * ((self.bias - (self.b.vel - self.a.vel).dot(axis)) / self.k)
    self.a.vel -= impulse * self.a.inv_mass
    self.b.vel += impulse * self.b.inv_mass
# END TODO 3
