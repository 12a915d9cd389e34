"""Clamps only when one of the bodies is static."""

# TODO 4: clamp the friction total
limit = friction_limit(c)
if a.is_static or b.is_static:
    total = max(-limit, min(limit, total))
# END TODO 4
