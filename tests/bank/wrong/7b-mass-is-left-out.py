"""Computes the moment for a mass of 1 and forgets to multiply."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(1, 0, radius)
# END TODO 7b
