"""Draws the square root over the whole product."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction * c.jn)
total = max(-limit, min(limit, total))
# END TODO 4
