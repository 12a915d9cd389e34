"""Keyword arguments and offset."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(mass=mass, inner_radius=0, outer_radius=radius, offset=(0, 0))
# END TODO 7b
