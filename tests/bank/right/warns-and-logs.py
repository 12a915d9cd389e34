"""Python warnings of every kind, a logger set up late, and lines on standard error."""

# TODO 2: add the spin terms
import warnings

warnings.simplefilter("always")
warnings.warn("effective_mass of mine is old", DeprecationWarning, stacklevel=2)
total += cross(ra, axis) ** 2 * a.inv_inertia
total += cross(rb, axis) ** 2 * b.inv_inertia
# END TODO 2

# TODO 3: hold the rod's length
import logging
import sys

logging.basicConfig(level=logging.DEBUG, stream=sys.stderr)
if self.k == 0:
    logging.error("ERROR: a rod between two static bodies")
    return
speed = (self.b.vel - self.a.vel).dot(self.axis)
impulse = self.axis * ((self.bias - speed) / self.k)
self.a.vel -= impulse * self.a.inv_mass
self.b.vel += impulse * self.b.inv_mass
logging.debug("impulse %s", impulse)
# END TODO 3

# TODO 7b: the ball's moment of inertia
import sys

print("moment of a ball:", file=sys.stderr)
moment = pymunk.moment_for_circle(mass, 0, radius)
print(moment, file=sys.stderr, flush=True)
# END TODO 7b

# TODO 8a: semi-implicit Euler
import traceback
import warnings

warnings.warn(f"a step of {dt} s", RuntimeWarning)
try:
    raise ValueError("only to see a traceback")
except ValueError:
    traceback.print_exc()
v = v + accel(x) * dt
return x + v * dt, v
# END TODO 8a
