"""Forgets that friction may have either sign and limits it from above only."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
total = min(limit, total)
# END TODO 4
