"""Turns the arm by a right angle and takes the dot product."""

# TODO 2: add the spin terms
perp_a = Vector2(-ra.y, ra.x)
perp_b = Vector2(-rb.y, rb.x)
total += perp_a.dot(axis) ** 2 * a.inv_inertia + perp_b.dot(axis) ** 2 * b.inv_inertia
# END TODO 2
