"""A moment, and not that of a disc."""

# TODO 7b: the ball's moment of inertia
moment = mass * radius**2
# END TODO 7b
