"""Clamps by pygame.math.clamp, and compares squares of lengths."""

# TODO 1: find the contact of a circle and a box
from pygame.math import clamp

x = clamp(a.pos.x, b.pos.x - b.shape.half.x, b.pos.x + b.shape.half.x)
y = clamp(a.pos.y, b.pos.y - b.shape.half.y, b.pos.y + b.shape.half.y)
closest = Vector2(x, y)
to_box = closest - a.pos
r = a.shape.radius
if to_box.length_squared() >= r * r:
    return None
if to_box.length_squared() > 0:
    return Contact(a, b, to_box.normalize(), r - to_box.length(), closest)
# inside
rel = a.pos - b.pos
gap_x = b.shape.half.x - abs(rel.x)
gap_y = b.shape.half.y - abs(rel.y)
if gap_x < gap_y:
    s = 1 if rel.x > 0 else -1
    return Contact(a, b, Vector2(-s, 0), r + gap_x, Vector2(b.pos.x + s * b.shape.half.x, a.pos.y))
s = 1 if rel.y > 0 else -1
return Contact(a, b, Vector2(0, -s), r + gap_y, Vector2(a.pos.x, b.pos.y + s * b.shape.half.y))
# END TODO 1
