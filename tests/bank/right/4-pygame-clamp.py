"""Pygame.math.clamp."""

# TODO 4: clamp the friction total
from pygame.math import clamp
most = friction_limit(c)
total = clamp(total, -most, most)
# END TODO 4
