"""Stops bodies that hardly spin."""

# TODO 2: add the spin terms
total += cross(ra, axis) ** 2 * a.inv_inertia
total += cross(rb, axis) ** 2 * b.inv_inertia
for body in (a, b):
    if abs(body.omega) < 0.05:
        body.omega = 0.0
# END TODO 2
