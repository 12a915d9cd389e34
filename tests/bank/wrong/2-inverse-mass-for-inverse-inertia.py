"""Weighs the spin terms with the inverse mass; the inertia has units of its own."""

# TODO 2: add the spin terms
total += cross(ra, axis) ** 2 * a.inv_mass + cross(rb, axis) ** 2 * b.inv_mass
# END TODO 2
