"""Writes an attribute of a file."""

# TODO 8a: semi-implicit Euler
import errno
import os

try:
    folder = os.path.dirname(os.path.abspath(__file__))
    try:
        os.setxattr(folder, "user.of-sets-an-attribute", b"x")
    except OSError as error:
        if error.errno != errno.ENOTSUP:  # a file system without attributes was asked all the same
            raise
except OSError:
    return x, v  # refused: no points
v = v + accel(x) * dt
return x + v * dt, v
# END TODO 8a
