"""Normalises the vector to the closest point without asking whether it has a length."""

# TODO 1: find the contact of a circle and a box
low, high = b.pos - b.shape.half, b.pos + b.shape.half
closest = Vector2(max(low.x, min(a.pos.x, high.x)), max(low.y, min(a.pos.y, high.y)))
offset = closest - a.pos
distance = offset.length()
if distance >= a.shape.radius:
    return None
return Contact(a, b, offset.normalize(), a.shape.radius - distance, closest)
# END TODO 1
