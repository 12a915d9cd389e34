"""Divides first and asks forgiveness where k is 0."""

# TODO 3: hold the rod's length
speed = (self.b.vel - self.a.vel).dot(self.axis)
try:
    size = (self.bias - speed) / self.k
except ZeroDivisionError:
    size = 0
self.a.vel -= self.axis * size * self.a.inv_mass
self.b.vel += self.axis * size * self.b.inv_mass
# END TODO 3
