"""Shortens the caller's arms to their parts across the axis."""

# TODO 2: add the spin terms
ra -= axis * ra.dot(axis)
rb -= axis * rb.dot(axis)
total += cross(ra, axis) ** 2 * a.inv_inertia
total += cross(rb, axis) ** 2 * b.inv_inertia
# END TODO 2
