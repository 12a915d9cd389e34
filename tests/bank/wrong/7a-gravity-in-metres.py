"""Knows 9.81 m/s² by heart and forgets that lengths are in px here."""

# TODO 7a: gravity
space.gravity = (0, 9.81)
# END TODO 7a
