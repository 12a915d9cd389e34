"""A copied line in which only the body was changed: both terms use the arm of A."""

# TODO 2: add the spin terms
total += cross(ra, axis) ** 2 * a.inv_inertia
total += cross(ra, axis) ** 2 * b.inv_inertia
# END TODO 2
