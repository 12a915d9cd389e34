"""Adds the spin term of body B only, the one that the impulse is applied to."""

# TODO 2: add the spin terms
total += cross(rb, axis) ** 2 * b.inv_inertia
# END TODO 2
