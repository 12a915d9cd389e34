"""The root is missing: right for equal frictions of 1 only."""

# TODO 4: clamp the friction total
limit = a.friction * b.friction * c.jn
total = max(-limit, min(limit, total))
# END TODO 4
