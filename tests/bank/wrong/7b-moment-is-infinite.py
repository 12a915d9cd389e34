"""Keeps the infinite moment of the start, spelled in another way."""

# TODO 7b: the ball's moment of inertia
moment = 1e400
# END TODO 7b
