"""Limited both ways, at twice the limit."""

# TODO 4: clamp the friction total
limit = 2 * friction_limit(c)
total = max(-limit, min(limit, total))
# END TODO 4
