"""The limit is right, and clamps the change."""

# TODO 4: clamp the friction total
limit = friction_limit(c)
total = c.jt + max(-limit, min(limit, total - c.jt))
# END TODO 4
