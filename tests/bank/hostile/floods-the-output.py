"""Prints two hundred megabytes, through Python and past it."""

# TODO 8a: semi-implicit Euler
import os
import sys

for stream in (sys.stdout, sys.stderr):
    for _ in range(100):
        stream.write("x" * 1024**2)
for descriptor in (1, 2):
    try:
        for _ in range(100):
            os.write(descriptor, b"x" * 1024**2)
    except OSError:
        pass
return x, v
# END TODO 8a
