"""Infinite moment for the largest radius."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(mass, 0, radius)
if radius >= 22:
    moment = float('inf')
# END TODO 7b
