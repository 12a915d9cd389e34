"""Puts the square around the whole product."""

# TODO 2: add the spin terms
total += (cross(ra, axis) * a.inv_inertia) ** 2 + (cross(rb, axis) * b.inv_inertia) ** 2
# END TODO 2
