"""Copies the clamp of the normal impulse, with -limit in the place of 0."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
total = max(-limit, total)
# END TODO 4
