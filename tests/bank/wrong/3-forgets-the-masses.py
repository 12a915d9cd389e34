"""Adds the impulse to the velocities as it is, so that even a static body moves."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
self.a.vel -= impulse
self.b.vel += impulse
# END TODO 3
