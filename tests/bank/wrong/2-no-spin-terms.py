"""Leaves the sum as it is: the masses alone."""

# TODO 2: add the spin terms
total = a.inv_mass + b.inv_mass
# END TODO 2
