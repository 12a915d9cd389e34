"""Adds the second body's term where the first has none."""

# TODO 2: add the spin terms
if a.inv_inertia:
    total += cross(ra, axis) ** 2 * a.inv_inertia
else:
    total += cross(rb, axis) ** 2 * b.inv_inertia
# END TODO 2
