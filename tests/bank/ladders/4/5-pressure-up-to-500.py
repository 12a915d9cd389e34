"""Right but for heavy bodies."""

# TODO 4: clamp the friction total
limit = min(friction_limit(c), 500.0)
total = max(-limit, min(limit, total))
# END TODO 4
