"""Lets friction push one way only, as a normal impulse does."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
total = max(0.0, min(limit, total))
# END TODO 4
