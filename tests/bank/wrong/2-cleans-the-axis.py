"""Sets a small component of the axis to 0, in the caller's vector."""

# TODO 2: add the spin terms
if abs(axis.x) < 0.001:
    axis.x = 0.0
if abs(axis.y) < 0.001:
    axis.y = 0.0
total += cross(ra, axis) ** 2 * a.inv_inertia
total += cross(rb, axis) ** 2 * b.inv_inertia
# END TODO 2
