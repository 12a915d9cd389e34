"""Collects the answer in a variable and returns once, at the end."""

# TODO 1: find the contact of a circle and a box
result = None
r = a.shape.radius
half_w, half_h = b.shape.half
dx = a.pos.x - b.pos.x
dy = a.pos.y - b.pos.y
nearest = Vector2(b.pos.x + max(-half_w, min(half_w, dx)), b.pos.y + max(-half_h, min(half_h, dy)))
inside = abs(dx) <= half_w and abs(dy) <= half_h
if inside:
    penetration_x = half_w - abs(dx)
    penetration_y = half_h - abs(dy)
    if penetration_y <= penetration_x:
        normal = Vector2(0, -1 if dy > 0 else 1)
        nearest = Vector2(a.pos.x, b.pos.y - normal.y * half_h)
        depth = r + penetration_y
    else:
        normal = Vector2(-1 if dx > 0 else 1, 0)
        nearest = Vector2(b.pos.x - normal.x * half_w, a.pos.y)
        depth = r + penetration_x
    result = Contact(a=a, b=b, normal=normal, depth=depth, point=nearest)
else:
    gap = nearest - a.pos
    if gap.length() < r:
        result = Contact(a=a, b=b, normal=gap.normalize(), depth=r - gap.length(), point=nearest)
return result
# END TODO 1
