"""Writes the cross products out and starts the sum anew."""

# TODO 2: add the spin terms
ta = ra.x * axis.y - ra.y * axis.x
tb = rb.x * axis.y - rb.y * axis.x
total = b.inv_inertia * tb * tb + a.inv_inertia * ta * ta + b.inv_mass + a.inv_mass
# END TODO 2
