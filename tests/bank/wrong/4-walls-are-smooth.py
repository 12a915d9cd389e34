"""Contacts at walls (level normal) get no friction."""

# TODO 4: clamp the friction total
limit = friction_limit(c) if abs(c.normal.y) > 0.01 else 0.0
total = max(-limit, min(limit, total))
# END TODO 4
