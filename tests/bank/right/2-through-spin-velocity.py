"""Asks what speed along the axis a unit impulse gives, by way of the spin it causes."""

# TODO 2: add the spin terms
for body, arm in ((a, ra), (b, rb)):
    spin = cross(arm, axis) * body.inv_inertia
    total += spin_velocity(spin, arm).dot(axis)
# END TODO 2
