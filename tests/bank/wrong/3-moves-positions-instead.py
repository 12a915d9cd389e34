"""Puts B back on its circle instead of changing velocities."""

# TODO 3: hold the rod's length
self.b.pos = self.a.pos + self.axis * self.length
# END TODO 3
