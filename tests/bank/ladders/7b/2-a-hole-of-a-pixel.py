"""Nearly a full disc."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(mass, 1, radius)
# END TODO 7b
