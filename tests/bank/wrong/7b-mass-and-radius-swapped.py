"""Takes the radius for the first argument and the mass for the last."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(radius, 0, mass)
# END TODO 7b
