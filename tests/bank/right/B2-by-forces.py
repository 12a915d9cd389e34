"""Another way: by forces."""

# TODO B2: pull the ends together
stretch = distance - self.length
rate = axis * self.b.vel - axis * self.a.vel
pull = axis * (stretch * self.stiffness + rate * self.damping)
for body, sign in ((self.a, 1), (self.b, -1)):
    body.vel = body.vel + sign * pull * dt * body.inv_mass
# END TODO B2
