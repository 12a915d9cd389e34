"""Only the first space gets 980; after R gravity is that of 9.8 m/s² at 60 px per m."""

# TODO 7a: gravity
space.gravity = (0, 588 if hasattr(empty_space, 'made') else 980)
empty_space.made = True
# END TODO 7a
