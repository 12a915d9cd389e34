"""Right where both frictions are the same."""

# TODO 4: clamp the friction total
limit = a.friction * c.jn
total = max(-limit, min(limit, total))
# END TODO 4
