"""The gravity is right, and the damping is changed."""

# TODO 7a: gravity
space.gravity = (0, 980)
space.damping = 0.7
# END TODO 7a
