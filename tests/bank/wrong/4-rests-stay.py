"""Sets the slow ball's vel.x to 0 when total is within the limit and /vel/ < 3."""

# TODO 4: clamp the friction total
limit = friction_limit(c)
total = max(-limit, min(limit, total))
if abs(total) < limit and a.vel.length() < 3:
    a.vel = Vector2(0, 0)
# END TODO 4
