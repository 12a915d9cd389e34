"""Takes the friction of body A for both."""

# TODO 4: clamp the friction total
limit = c.a.friction * c.jn
total = max(-limit, min(limit, total))
# END TODO 4
