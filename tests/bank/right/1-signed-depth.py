"""One signed distance for both cases."""

# TODO 1: find the contact of a circle and a box
import math
dx, dy = b.pos.x - a.pos.x, b.pos.y - a.pos.y
hx, hy = b.shape.half
over_x, over_y = abs(dx) - hx, abs(dy) - hy
side_x, side_y = (1 if dx > 0 else -1), (1 if dy > 0 else -1)
r = a.shape.radius
if over_x > 0 and over_y > 0:  # beside a corner
    d = math.hypot(over_x, over_y)
    normal = Vector2(side_x * over_x / d, side_y * over_y / d)
elif over_x > 0 or (over_y <= 0 and over_x > over_y):  # beside, or nearest to, a side
    d, normal = over_x, Vector2(side_x, 0)
else:  # above, below, or nearest to one of these
    d, normal = over_y, Vector2(0, side_y)
# d is negative inside: then it is minus the gap
return Contact(a, b, normal, r - d, a.pos + normal * d) if d < r else None
# END TODO 1
