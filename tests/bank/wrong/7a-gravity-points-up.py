"""Takes y for pointing up, as in mathematics."""

# TODO 7a: gravity
space.gravity = (0, -980)
# END TODO 7a
