"""Has no answer for a centre inside."""

# TODO 1: find the contact of a circle and a box
low, high = b.pos - b.shape.half, b.pos + b.shape.half
closest = Vector2(max(low.x, min(a.pos.x, high.x)), max(low.y, min(a.pos.y, high.y)))
offset = closest - a.pos
distance = offset.length()
if distance >= a.shape.radius:
    return None
if distance == 0:
    return None
return Contact(a, b, offset / distance, a.shape.radius - distance, closest)
# END TODO 1
