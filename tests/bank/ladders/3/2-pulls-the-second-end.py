"""Moves B alone, and only towards A."""

# TODO 3: hold the rod's length
speed = (self.b.vel - self.a.vel).dot(self.axis)
if self.k and speed > self.bias:
    self.b.vel += self.axis * ((self.bias - speed) / self.k * self.b.inv_mass)
# END TODO 3
