"""Takes a friction that would pass its limit for one that must not act at all."""

# TODO 4: clamp the friction total
if abs(total) > 0:
    total = 0.0
# END TODO 4
