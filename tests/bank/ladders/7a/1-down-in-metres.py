"""The right way, and a hundredth as much."""

# TODO 7a: gravity
space.gravity = (0, 9.8)
# END TODO 7a
