"""Shares the change of speed out by the inverse masses."""

# TODO 3: hold the rod's length
if self.k > 0:
    wanted = self.bias - self.axis.dot(self.b.vel) + self.axis.dot(self.a.vel)
    share_b = self.b.inv_mass / self.k
    share_a = self.a.inv_mass / self.k
    self.b.vel = self.b.vel + wanted * share_b * self.axis
    self.a.vel = self.a.vel - wanted * share_a * self.axis
# END TODO 3
