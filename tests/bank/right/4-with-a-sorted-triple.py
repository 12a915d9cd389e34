"""The middle one of three numbers, and a power instead of a root."""

# TODO 4: clamp the friction total
limit = (c.a.friction * c.b.friction) ** 0.5 * c.jn
total = sorted((-limit, total, limit))[1]
# END TODO 4
