"""As it should be."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(mass, 0, radius)
# END TODO 7b
