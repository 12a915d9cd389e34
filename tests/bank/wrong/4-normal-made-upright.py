"""Turns c.normal to exactly upright when it nearly is."""

# TODO 4: clamp the friction total
limit = friction_limit(c)
total = max(-limit, min(limit, total))
if abs(c.normal.x) < 0.05:
    c.normal = Vector2(0, math.copysign(1, c.normal.y))
# END TODO 4
