"""Applies the bias in every pass, whatever speed the two have by now."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
impulse = self.axis * (self.bias / self.k)
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
# END TODO 3
