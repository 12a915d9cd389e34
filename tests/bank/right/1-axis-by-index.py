"""Picks the axis by its index, and works in the box's own frame."""

# TODO 1: find the contact of a circle and a box
def clamp(value, low, high):
    return low if value < low else high if value > high else value

half = b.shape.half
offset = a.pos - b.pos
inside_point = Vector2(clamp(offset.x, -half.x, half.x), clamp(offset.y, -half.y, half.y))
delta = inside_point - offset
if delta.x == 0 and delta.y == 0:
    gaps = half - Vector2(abs(offset.x), abs(offset.y))
    axis = 0 if gaps[0] < gaps[1] else 1
    way = Vector2()
    way[axis] = -1.0 if offset[axis] < 0 else 1.0
    face = Vector2(a.pos)
    face[axis] = b.pos[axis] + way[axis] * half[axis]
    return Contact(a, b, -way, a.shape.radius + gaps[axis], face)
if delta * delta >= a.shape.radius**2:
    return None
return Contact(a, b, delta / delta.magnitude(), a.shape.radius - delta.magnitude(), b.pos + inside_point)
# END TODO 1
