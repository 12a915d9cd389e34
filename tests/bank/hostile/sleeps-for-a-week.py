"""Sleeps for a week, then gives up."""

# TODO 8c: RK4
import time

time.sleep(6e5)
return x, v
# END TODO 8c
