"""Also sets space.iterations to 30."""

# TODO 7a: gravity
space.gravity = (0, 980)
space.iterations = 30
# END TODO 7a
