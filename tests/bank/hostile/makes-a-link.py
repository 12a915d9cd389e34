"""Makes a link to a folder outside."""

# TODO 8a: semi-implicit Euler
import os
import tempfile

try:
    path = os.path.join(tempfile.gettempdir(), f"of-makes-a-link-{os.getpid()}")
    os.symlink("/etc", path)
    os.unlink(path)
except OSError:
    return x, v  # refused: no points
v = v + accel(x) * dt
return x + v * dt, v
# END TODO 8a
