"""Adds the second body's term only where the first one cannot turn."""

# TODO 2: add the spin terms
if a.inv_inertia > 0:
    total += cross(ra, axis) ** 2 * a.inv_inertia
elif b.inv_inertia > 0:
    total += cross(rb, axis) ** 2 * b.inv_inertia
# END TODO 2
