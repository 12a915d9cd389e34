"""Gives the ball the moment of the box around it."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_box(mass, (2 * radius, 2 * radius))
# END TODO 7b
