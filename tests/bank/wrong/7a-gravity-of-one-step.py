"""Gives the speed that one step adds, although step multiplies by its length itself."""

# TODO 7a: gravity
space.gravity = (0, 980 * STEP)
# END TODO 7a
