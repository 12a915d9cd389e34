"""Leaves out the square: a term may even be negative, depending on the side."""

# TODO 2: add the spin terms
total += cross(ra, axis) * a.inv_inertia + cross(rb, axis) * b.inv_inertia
# END TODO 2
