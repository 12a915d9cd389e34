"""Multiplies the two coefficients without taking the root."""

# TODO 4: clamp the friction total
limit = c.a.friction * c.b.friction * c.jn
total = max(-limit, min(limit, total))
# END TODO 4
