"""Keeps the shares of each dt, and misses that a rate was changed."""

# TODO 5: damp by a rate per second
kept = self.__dict__.setdefault("kept", {})
if dt not in kept:
    kept[dt] = math.exp(-self.linear_damping * dt), math.exp(-self.angular_damping * dt)
keep_vel, keep_omega = kept[dt]
# END TODO 5
