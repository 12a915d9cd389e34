"""Computes a single power inside of C, where no line of Python is reached."""

# TODO 8a: semi-implicit Euler
v = 7 ** (7**20)
# END TODO 8a
