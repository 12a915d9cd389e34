"""Keeps the value of an example found on the web."""

# TODO 7a: gravity
space.gravity = (0, 900)
# END TODO 7a
