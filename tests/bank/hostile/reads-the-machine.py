"""Reads files of the machine."""

# TODO 8a: semi-implicit Euler
import os

try:
    with open("/etc/passwd") as file:
        file.read(1)
except OSError:
    return x, v  # refused: no points
v = v + accel(x) * dt
return x + v * dt, v
# END TODO 8a
