"""By half-life: 0.5 ** (dt / half life), with no damping handled by an if."""

# TODO 5: damp by a rate per second
def kept(rate):
    if rate == 0:
        return 1.0
    half_life = math.log(2) / rate
    return 0.5 ** (dt / half_life)

keep_vel, keep_omega = kept(self.linear_damping), kept(self.angular_damping)
# END TODO 5
