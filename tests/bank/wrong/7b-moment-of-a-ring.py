"""Takes the inner radius for the radius as well, so the ball becomes a thin ring."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(mass, radius, radius)
# END TODO 7b
