"""Computes the limit, and the line that uses it never got written."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
# END TODO 4
