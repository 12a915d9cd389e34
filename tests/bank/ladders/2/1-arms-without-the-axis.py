"""Squares the whole arms."""

# TODO 2: add the spin terms
total += ra.length_squared() * a.inv_inertia
total += rb.length_squared() * b.inv_inertia
# END TODO 2
