"""Computes the force again for b after a has changed: not opposite."""

# TODO B2: pull the ends together
for body, sign in ((self.a, 1), (self.b, -1)):
    speed = (self.b.vel - self.a.vel).dot(axis)
    force = self.stiffness * (distance - self.length) + self.damping * speed
    body.vel += axis * (sign * force * dt * body.inv_mass)
# END TODO B2
