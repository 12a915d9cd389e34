"""Clamps to the friction coefficient alone, however hard the bodies press."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction)
total = max(-limit, min(limit, total))
# END TODO 4
