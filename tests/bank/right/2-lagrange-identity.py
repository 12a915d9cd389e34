"""Gets the square of the cross product from lengths and a dot product."""

# TODO 2: add the spin terms
for body, r in ((a, ra), (b, rb)):
    total = total + (r.length_squared() * axis.length_squared() - r.dot(axis) ** 2) * body.inv_inertia
# END TODO 2
