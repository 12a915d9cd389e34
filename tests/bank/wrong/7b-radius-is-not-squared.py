"""Writes the disc's formula from memory and loses the square."""

# TODO 7b: the ball's moment of inertia
moment = 0.5 * mass * radius
# END TODO 7b
