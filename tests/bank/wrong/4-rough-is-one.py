"""Frictions above 1 count as 1."""

# TODO 4: clamp the friction total
limit = math.sqrt(min(a.friction, 1) * min(b.friction, 1)) * c.jn
total = max(-limit, min(limit, total))
# END TODO 4
