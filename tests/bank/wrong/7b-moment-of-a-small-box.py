"""Gives the ball the moment of a box as wide as its radius."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_box(mass, (radius, radius))
# END TODO 7b
