"""Keeps the corners on the shape, and misses that a box has moved."""

# TODO 1: find the contact of a circle and a box
if not hasattr(b.shape, 'corners'):
    b.shape.corners = b.pos - b.shape.half, b.pos + b.shape.half
low, high = b.shape.corners
centre, radius = a.pos, a.shape.radius
closest = Vector2(max(low.x, min(centre.x, high.x)), max(low.y, min(centre.y, high.y)))
offset = closest - centre
distance = offset.length()
if distance >= radius:
    return None
if distance > 0:
    return Contact(a, b, offset / distance, radius - distance, closest)
faces = [
    (centre.y - low.y, Vector2(0, 1), Vector2(centre.x, low.y)),
    (high.y - centre.y, Vector2(0, -1), Vector2(centre.x, high.y)),
    (centre.x - low.x, Vector2(1, 0), Vector2(low.x, centre.y)),
    (high.x - centre.x, Vector2(-1, 0), Vector2(high.x, centre.y)),
]
gap, normal, point = min(faces, key=lambda face: face[0])
return Contact(a, b, normal, radius + gap, point)
# END TODO 1
