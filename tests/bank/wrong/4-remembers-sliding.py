"""A contact that has slid once keeps only 80 % of its limit (kept on the body)."""

# TODO 4: clamp the friction total
limit = friction_limit(c) * (0.8 if getattr(a, 'slides', False) else 1.0)
a.slides = abs(total) > limit
total = max(-limit, min(limit, total))
# END TODO 4
