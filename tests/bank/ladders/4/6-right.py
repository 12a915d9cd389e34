"""As it should be."""

# TODO 4: clamp the friction total
limit = friction_limit(c)
total = max(-limit, min(limit, total))
# END TODO 4
