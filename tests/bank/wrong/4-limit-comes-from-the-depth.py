"""Takes the depth of the overlap for the pressure."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.depth
total = max(-limit, min(limit, total))
# END TODO 4
