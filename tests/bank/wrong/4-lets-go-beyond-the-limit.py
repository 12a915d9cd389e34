"""Gives up altogether when friction cannot stop the slip."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
if abs(total) > limit:
    total = 0.0
# END TODO 4
