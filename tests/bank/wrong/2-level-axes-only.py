"""Forgets the mixed term, which is 0 for level and upright axes."""

# TODO 2: add the spin terms
total += ((ra.x * axis.y) ** 2 + (ra.y * axis.x) ** 2) * a.inv_inertia
total += ((rb.x * axis.y) ** 2 + (rb.y * axis.x) ** 2) * b.inv_inertia
# END TODO 2
