"""Works with absolute values in the box's own frame."""

# TODO 1: find the contact of a circle and a box
import math
half = b.shape.half
local = a.pos - b.pos
outside_x = max(abs(local.x) - half.x, 0)
outside_y = max(abs(local.y) - half.y, 0)
distance = math.hypot(outside_x, outside_y)
if distance >= a.shape.radius:
    return None
if distance == 0:
    if half.x - abs(local.x) < half.y - abs(local.y):
        out = Vector2(math.copysign(1, local.x), 0)
        gap = half.x - abs(local.x)
    else:
        out = Vector2(0, math.copysign(1, local.y))
        gap = half.y - abs(local.y)
    return Contact(a, b, -out, a.shape.radius + gap, a.pos + out * gap)
normal = -Vector2(math.copysign(outside_x, local.x), math.copysign(outside_y, local.y)) / distance
return Contact(a, b, normal, a.shape.radius - distance, a.pos + normal * distance)
# END TODO 1
