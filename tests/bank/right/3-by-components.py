"""Adds to the components of the velocities, one by one."""

# TODO 3: hold the rod's length
a, b, n = self.a, self.b, self.axis
if self.k != 0:
    vx = b.vel.x - a.vel.x
    vy = b.vel.y - a.vel.y
    p = (self.bias - (vx * n.x + vy * n.y)) / self.k
    a.vel.x -= p * n.x * a.inv_mass
    a.vel.y -= p * n.y * a.inv_mass
    b.vel.x += p * n.x * b.inv_mass
    b.vel.y += p * n.y * b.inv_mass
# END TODO 3
