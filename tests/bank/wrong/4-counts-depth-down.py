"""Takes the slop off c.depth while it is at it."""

# TODO 4: clamp the friction total
limit = friction_limit(c)
total = max(-limit, min(limit, total))
c.depth = max(c.depth - 0.5, 0.0)
# END TODO 4
