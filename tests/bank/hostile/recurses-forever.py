"""Calls itself, with the limit lifted."""

# TODO 8b: velocity Verlet
import sys

sys.setrecursionlimit(10**8)
return velocity_verlet(x, v, dt, accel)
# END TODO 8b
