"""Takes the middle of three sorted numbers for the clamp."""

# TODO 1: find the contact of a circle and a box
lo, hi = b.pos - b.shape.half, b.pos + b.shape.half
closest = Vector2(sorted((lo.x, a.pos.x, hi.x))[1], sorted((lo.y, a.pos.y, hi.y))[1])
dist = a.pos.distance_to(closest)
if dist >= a.shape.radius:
    return None
if dist > 0:
    return Contact(a, b, (closest - a.pos).normalize(), a.shape.radius - dist, closest)
faces = {(1, 0): a.pos.x - lo.x, (-1, 0): hi.x - a.pos.x, (0, 1): a.pos.y - lo.y, (0, -1): hi.y - a.pos.y}
normal = Vector2(min(faces, key=faces.get))
gap = min(faces.values())
return Contact(a, b, normal, a.shape.radius + gap, a.pos - normal * gap)
# END TODO 1
