"""No direction to normalise: that is how the inside is found."""

# TODO 1: find the contact of a circle and a box
low, high = b.pos - b.shape.half, b.pos + b.shape.half
closest = Vector2(min(max(a.pos.x, low.x), high.x), min(max(a.pos.y, low.y), high.y))
way = closest - a.pos
try:
    normal = way.normalize()
except ValueError:  # no direction: the centre is inside
    depths = sorted(
        [
            (a.pos.x - low.x, 0, 1),
            (high.x - a.pos.x, 0, -1),
            (a.pos.y - low.y, 1, 1),
            (high.y - a.pos.y, 1, -1),
        ]
    )
    gap, axis, sign = depths[0]
    normal = Vector2(sign, 0) if axis == 0 else Vector2(0, sign)
    closest = a.pos - normal * gap
    return Contact(a, b, normal, a.shape.radius + gap, closest)
if way.length() >= a.shape.radius:
    return None
return Contact(a, b, normal, a.shape.radius - way.length(), closest)
# END TODO 1
