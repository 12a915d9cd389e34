"""Clamps each pass's change to the limit instead of the accumulated total."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
total = c.jt + max(-limit, min(limit, total - c.jt))
# END TODO 4
