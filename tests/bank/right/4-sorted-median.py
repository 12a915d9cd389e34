"""Median of three."""

# TODO 4: clamp the friction total
_, total, _ = sorted([-friction_limit(c), total, friction_limit(c)])
# END TODO 4
