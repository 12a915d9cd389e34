"""Adds nothing."""

# TODO 2: add the spin terms
pass
# END TODO 2
