"""Compares coordinate by coordinate, without a clamp."""

# TODO 1: find the contact of a circle and a box
cx, cy = a.pos
left = b.pos.x - b.shape.half.x
right = b.pos.x + b.shape.half.x
top = b.pos.y - b.shape.half.y
bottom = b.pos.y + b.shape.half.y

if cx < left:
    px = left
elif cx > right:
    px = right
else:
    px = cx
if cy < top:
    py = top
elif cy > bottom:
    py = bottom
else:
    py = cy

if (px, py) == (cx, cy):
    # centre is in the box
    d_left = cx - left
    d_right = right - cx
    d_top = cy - top
    d_bottom = bottom - cy
    smallest = min(d_left, d_right, d_top, d_bottom)
    if smallest == d_top:
        normal, point = Vector2(0, 1), Vector2(cx, top)
    elif smallest == d_bottom:
        normal, point = Vector2(0, -1), Vector2(cx, bottom)
    elif smallest == d_left:
        normal, point = Vector2(1, 0), Vector2(left, cy)
    else:
        normal, point = Vector2(-1, 0), Vector2(right, cy)
    return Contact(a, b, normal, a.shape.radius + smallest, point)

d = ((px - cx) ** 2 + (py - cy) ** 2) ** 0.5
if d >= a.shape.radius:
    return None
return Contact(a, b, Vector2((px - cx) / d, (py - cy) / d), a.shape.radius - d, Vector2(px, py))
# END TODO 1
