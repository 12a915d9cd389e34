"""A shape on nobody tells the moment."""

# TODO 7b: the ball's moment of inertia
disc = pymunk.Circle(None, radius)
disc.mass = mass
moment = disc.moment  # pymunk works it out
# END TODO 7b
