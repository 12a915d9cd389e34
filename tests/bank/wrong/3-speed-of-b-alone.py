"""Takes the speed of B, as if A were the peg of the lab scene."""

# TODO 3: hold the rod's length
if self.k == 0:
    return
speed = self.b.vel.dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
# END TODO 3
