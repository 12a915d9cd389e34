"""If abs(total) is too large, copysign."""

# TODO 4: clamp the friction total
if abs(total) > friction_limit(c):
    total = math.copysign(friction_limit(c), total)
# END TODO 4
