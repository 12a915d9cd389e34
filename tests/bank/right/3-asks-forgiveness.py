"""Divides first and catches the zero, then shares the change of speed out by weight."""

# TODO 3: hold the rod's length
try:
    share_a, share_b = self.a.inv_mass / self.k, self.b.inv_mass / self.k
except ZeroDivisionError:
    share_a = share_b = 0
wanted = self.bias - self.b.vel.dot(self.axis) + self.a.vel.dot(self.axis)
self.a.vel = self.a.vel - share_a * wanted * self.axis
self.b.vel = self.b.vel + share_b * wanted * self.axis
# END TODO 3
