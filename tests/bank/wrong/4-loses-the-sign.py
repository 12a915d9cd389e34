"""Compares sizes and forgets the sign: friction always acts in the same direction."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
total = min(abs(total), limit)
# END TODO 4
