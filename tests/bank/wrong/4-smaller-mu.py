"""Takes the smaller coefficient, as the bounce takes the smaller restitution."""

# TODO 4: clamp the friction total
limit = min(c.a.friction, c.b.friction) * c.jn
total = max(-limit, min(limit, total))
# END TODO 4
