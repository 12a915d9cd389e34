"""Cancels the whole relative velocity, so the pendulum stands still in the air."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
relative = self.b.vel - self.a.vel
impulse = (self.axis * self.bias - relative) / self.k
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
# END TODO 3
