"""Always applies the whole limit, even to a ball that rolls without slipping."""

# TODO 4: clamp the friction total
limit = math.sqrt(c.a.friction * c.b.friction) * c.jn
total = limit if total > 0 else -limit
# END TODO 4
