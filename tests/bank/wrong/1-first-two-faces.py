"""Looks at the left and the right face only."""

# TODO 1: find the contact of a circle and a box
low, high = b.pos - b.shape.half, b.pos + b.shape.half
closest = Vector2(max(low.x, min(a.pos.x, high.x)), max(low.y, min(a.pos.y, high.y)))
offset = closest - a.pos
distance = offset.length()
if distance >= a.shape.radius:
    return None
if distance > 0:
    return Contact(a, b, offset / distance, a.shape.radius - distance, closest)
faces = [
    (a.pos.x - low.x, Vector2(1, 0), Vector2(low.x, a.pos.y)),
    (high.x - a.pos.x, Vector2(-1, 0), Vector2(high.x, a.pos.y)),
    (a.pos.y - low.y, Vector2(0, 1), Vector2(a.pos.x, low.y)),
    (high.y - a.pos.y, Vector2(0, -1), Vector2(a.pos.x, high.y)),
]
gap, normal, point = min(faces[:2], key=lambda face: face[0])
return Contact(a, b, normal, a.shape.radius + gap, point)
# END TODO 1
