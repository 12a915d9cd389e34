"""Takes the friction of body B, the ground, for both."""

# TODO 4: clamp the friction total
limit = c.b.friction * c.jn
total = max(-limit, min(limit, total))
# END TODO 4
