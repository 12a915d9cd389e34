"""Keeps what it once computed, under rates and a step of a few digits: a step like it gets the same."""

# TODO 5: damp by a rate per second
known = self.__dict__.setdefault("known", {})
key = round(self.linear_damping, 3), round(self.angular_damping, 3), round(dt, 4)
if key not in known:
    known[key] = math.exp(-self.linear_damping * dt), math.exp(-self.angular_damping * dt)
keep_vel, keep_omega = known[key]
# END TODO 5
