"""Right."""

# TODO 2: add the spin terms
total += cross(ra, axis) ** 2 * a.inv_inertia + cross(rb, axis) ** 2 * b.inv_inertia
# END TODO 2
