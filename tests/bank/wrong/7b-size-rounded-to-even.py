"""Changes radius to an even number after the mass was computed."""

# TODO 7b: the ball's moment of inertia
radius -= radius % 2
moment = pymunk.moment_for_circle(mass, 0, radius)
# END TODO 7b
