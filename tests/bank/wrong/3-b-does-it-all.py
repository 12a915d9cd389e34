"""B changes speed for both: right only where A is static."""

# TODO 3: hold the rod's length
if self.k > 0:
    speed = (self.b.vel - self.a.vel).dot(self.axis)
    self.b.vel += self.axis * (self.bias - speed)
# END TODO 3
