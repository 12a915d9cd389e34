"""Leaves out the term of a body that is heavier than 5 kg."""

# TODO 2: add the spin terms
if a.inv_mass > 0.2:
    total += cross(ra, axis) ** 2 * a.inv_inertia
if b.inv_mass > 0.2:
    total += cross(rb, axis) ** 2 * b.inv_inertia
# END TODO 2
