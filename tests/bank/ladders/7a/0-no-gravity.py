"""Everything hangs in the air."""

# TODO 7a: gravity
space.gravity = (0, 0.0)
# END TODO 7a
