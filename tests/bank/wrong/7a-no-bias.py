"""Also sets collision_bias so that overlaps go at once."""

# TODO 7a: gravity
space.gravity = (0, 980)
space.collision_bias = 0.0
# END TODO 7a
