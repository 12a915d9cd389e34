"""Adds the inverse masses up again and changes the velocities in place."""

# TODO 3: hold the rod's length
weight = self.a.inv_mass + self.b.inv_mass
if weight != 0:
    n = self.axis
    j = (self.bias + n.dot(self.a.vel) - n.dot(self.b.vel)) / weight
    self.a.vel.x -= j * self.a.inv_mass * n.x
    self.a.vel.y -= j * self.a.inv_mass * n.y
    self.b.vel.x += j * self.b.inv_mass * n.x
    self.b.vel.y += j * self.b.inv_mass * n.y
# END TODO 3
