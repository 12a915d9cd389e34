"""Uses the whole length of the arm, even where the axis runs along it."""

# TODO 2: add the spin terms
total += ra.length_squared() * a.inv_inertia + rb.length_squared() * b.inv_inertia
# END TODO 2
