"""Returns from within the region, with a sum over both bodies."""

# TODO 2: add the spin terms
return total + sum(pow(r.cross(axis), 2) * body.inv_inertia for body, r in zip((a, b), (ra, rb)))
# END TODO 2
