"""Knows the top of a box, and nothing else of it."""

# TODO 1: find the contact of a circle and a box
low, high = b.pos - b.shape.half, b.pos + b.shape.half
depth = a.pos.y + a.shape.radius - low.y
if depth <= 0 or not low.x <= a.pos.x <= high.x or a.pos.y > low.y:
    return None
return Contact(a, b, Vector2(0, 1), depth, Vector2(a.pos.x, low.y))
# END TODO 1
