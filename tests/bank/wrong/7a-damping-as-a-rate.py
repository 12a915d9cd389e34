"""Also sets space.damping to 1 - 0.3 (spin rate of the mini engine)."""

# TODO 7a: gravity
space.gravity = (0, 980)
space.damping = 0.7
# END TODO 7a
