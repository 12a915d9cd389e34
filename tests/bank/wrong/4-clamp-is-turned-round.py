"""Mixes up min and max, so that the total is always -limit."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
total = min(-limit, max(limit, total))
# END TODO 4
