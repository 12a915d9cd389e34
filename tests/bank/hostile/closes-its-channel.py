"""Closes every descriptor it has, and loops."""

# TODO 8a: semi-implicit Euler
import os

os.closerange(0, 256)
while True:
    pass
# END TODO 8a
