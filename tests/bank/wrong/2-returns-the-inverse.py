"""Thinks that effective_mass must be a mass, and turns the sum over at the end."""

# TODO 2: add the spin terms
total += cross(ra, axis) ** 2 * a.inv_inertia + cross(rb, axis) ** 2 * b.inv_inertia
total = 1 / total
# END TODO 2
