"""Mixes up the two components."""

# TODO 7a: gravity
space.gravity = (980, 0)
# END TODO 7a
