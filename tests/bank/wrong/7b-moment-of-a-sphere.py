"""Uses the formula of a solid sphere; in the plane the ball is a disc."""

# TODO 7b: the ball's moment of inertia
moment = 2 / 5 * mass * radius**2
# END TODO 7b
