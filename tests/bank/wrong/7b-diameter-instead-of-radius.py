"""Gives the diameter where pymunk asks for the radius."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(mass, 0, 2 * radius)
# END TODO 7b
