"""Adds the first body's term alone."""

# TODO 2: add the spin terms
total += cross(ra, axis) ** 2 * a.inv_inertia
# END TODO 2
