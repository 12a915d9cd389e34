"""Gives up beyond the larger half and the radius: the corners of a square lie further out."""

# TODO 1: find the contact of a circle and a box
if (a.pos - b.pos).length() > max(b.shape.half) + a.shape.radius:
    return None
low, high = b.pos - b.shape.half, b.pos + b.shape.half
closest = Vector2(min(max(a.pos.x, low.x), high.x), min(max(a.pos.y, low.y), high.y))
offset = closest - a.pos
distance = offset.length()
if distance >= a.shape.radius:
    return None
if distance > 0:
    return Contact(a, b, offset / distance, a.shape.radius - distance, closest)
gaps = {
    (1, 0): a.pos.x - low.x,
    (-1, 0): high.x - a.pos.x,
    (0, 1): a.pos.y - low.y,
    (0, -1): high.y - a.pos.y,
}
normal = min(gaps, key=gaps.get)
gap = gaps[normal]
return Contact(a, b, Vector2(normal), a.shape.radius + gap, a.pos - gap * Vector2(normal))
# END TODO 1
