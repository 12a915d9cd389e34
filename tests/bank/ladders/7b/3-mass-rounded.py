"""A full disc of another mass."""

# TODO 7b: the ball's moment of inertia
mass = round(mass)
moment = pymunk.moment_for_circle(mass, 0, radius)
# END TODO 7b
