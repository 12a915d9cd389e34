"""Right but for a static first body, which rubs nothing."""

# TODO 4: clamp the friction total
limit = 0.0 if a.is_static else friction_limit(c)
total = max(-limit, min(limit, total))
# END TODO 4
