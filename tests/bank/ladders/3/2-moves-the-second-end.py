"""Pushes B alone, and A not the other way."""

# TODO 3: hold the rod's length
if self.k:
    speed = (self.b.vel - self.a.vel).dot(self.axis)
    self.b.vel += self.axis * ((self.bias - speed) / self.k * self.b.inv_mass)
# END TODO 3
