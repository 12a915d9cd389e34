"""The friction impulse may be as large as the normal impulse, on ice too."""

# TODO 4: clamp the friction total
limit = c.jn
total = max(-limit, min(limit, total))
# END TODO 4
