"""Also sets collision_slop to 0.5 (the mini engine's SLOP)."""

# TODO 7a: gravity
space.gravity = (0, 980)
space.collision_slop = 0.5
# END TODO 7a
