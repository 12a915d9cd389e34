"""Works the impulse out and does nothing with it."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
# END TODO 3
