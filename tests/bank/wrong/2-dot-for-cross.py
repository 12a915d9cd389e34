"""Takes the dot product of arm and axis for the lever arm."""

# TODO 2: add the spin terms
total += ra.dot(axis) ** 2 * a.inv_inertia + rb.dot(axis) ** 2 * b.inv_inertia
# END TODO 2
