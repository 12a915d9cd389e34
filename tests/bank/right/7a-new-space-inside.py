"""Makes the Space anew inside the region."""

# TODO 7a: gravity
space = pymunk.Space(threaded=False)
space.damping = 0.95
space.gravity = 0, 980
# END TODO 7a
