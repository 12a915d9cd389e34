"""No vectors: four comparisons outside, four distances inside."""

# TODO 1: find the contact of a circle and a box
x, y, r = a.pos.x, a.pos.y, a.shape.radius
left, right = b.pos.x - b.shape.half.x, b.pos.x + b.shape.half.x
top, bottom = b.pos.y - b.shape.half.y, b.pos.y + b.shape.half.y

if left <= x <= right and top <= y <= bottom:
    gaps = {"left": x - left, "right": right - x, "top": y - top, "bottom": bottom - y}
    side = min(gaps, key=gaps.get)
    depth = r + gaps[side]
    if side == "left":
        return Contact(a, b, Vector2(1, 0), depth, Vector2(left, y))
    elif side == "right":
        return Contact(a, b, Vector2(-1, 0), depth, Vector2(right, y))
    elif side == "top":
        return Contact(a, b, Vector2(0, 1), depth, Vector2(x, top))
    else:
        return Contact(a, b, Vector2(0, -1), depth, Vector2(x, bottom))

cx, cy = x, y
if x < left:
    cx = left
elif x > right:
    cx = right
if y < top:
    cy = top
elif y > bottom:
    cy = bottom

dist = ((cx - x) ** 2 + (cy - y) ** 2) ** 0.5
if not dist < r:
    return None
n = Vector2((cx - x) / dist, (cy - y) / dist)
return Contact(a, b, n, r - dist, Vector2(cx, cy))
# END TODO 1
