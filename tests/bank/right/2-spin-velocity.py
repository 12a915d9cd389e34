"""Gives each body the spin of a unit impulse and asks how fast its point then moves."""

# TODO 2: add the spin terms
spin_a = cross(ra, axis) * a.inv_inertia
spin_b = cross(rb, axis) * b.inv_inertia
total += spin_velocity(spin_a, ra).dot(axis) + spin_velocity(spin_b, rb).dot(axis)
# END TODO 2
