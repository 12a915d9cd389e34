"""Takes a static end to rest, whatever velocity it has."""

# TODO 3: hold the rod's length
if self.k > 0:
    speeds = [Vector2(0, 0) if end.is_static else end.vel for end in (self.a, self.b)]
    impulse = self.axis * ((self.bias - (speeds[1] - speeds[0]).dot(self.axis)) / self.k)
    self.a.vel -= impulse * self.a.inv_mass
    self.b.vel += impulse * self.b.inv_mass
# END TODO 3
