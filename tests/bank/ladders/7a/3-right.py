"""As it should be."""

# TODO 7a: gravity
space.gravity = (0, 980)
# END TODO 7a
