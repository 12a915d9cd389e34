"""Adds the spin term of body A only, the one that rolls on the floor."""

# TODO 2: add the spin terms
total += cross(ra, axis) ** 2 * a.inv_inertia
# END TODO 2
