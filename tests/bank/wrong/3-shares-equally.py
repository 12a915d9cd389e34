"""Lets each body take half of the change, as if their masses were equal."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
change = self.axis * ((self.bias - speed) / 2)
self.a.vel -= change
self.b.vel += change
# END TODO 3
