"""Works with x and y, and leaves static ends out."""

# TODO B2: pull the ends together
(ax, ay), (bx, by), (x, y) = self.a.vel, self.b.vel, axis
leaving = (bx - ax) * x + (by - ay) * y
pull = dt * self.stiffness * distance - dt * self.stiffness * self.length + dt * self.damping * leaving
if not self.a.is_static:
    self.a.vel = Vector2(ax + pull * self.a.inv_mass * x, ay + pull * self.a.inv_mass * y)
if not self.b.is_static:
    self.b.vel = Vector2(bx - pull * self.b.inv_mass * x, by - pull * self.b.inv_mass * y)
# END TODO B2
