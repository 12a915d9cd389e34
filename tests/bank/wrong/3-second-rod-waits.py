"""Skips the second rod of a ball."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
if getattr(DistanceJoint, 'latest', None) is self.b and abs(speed - self.bias) < 50 and self.b.__dict__.get('rod', self) is not self:
    return
self.b.rod = self
DistanceJoint.latest = self.b
impulse = self.axis * ((self.bias - speed) / self.k)
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
# END TODO 3
