"""Works with the offset from the box's centre and pygame's own clamp."""

# TODO 1: find the contact of a circle and a box
from pygame.math import clamp

radius, half = a.shape.radius, b.shape.half
offset = a.pos - b.pos
nearest = Vector2(clamp(offset.x, -half.x, half.x), clamp(offset.y, -half.y, half.y))
away = offset - nearest
if away:
    if away.magnitude_squared() >= radius * radius:
        return None
    return Contact(a, b, -away.normalize(), radius - away.magnitude(), b.pos + nearest)
room = half - Vector2(abs(offset.x), abs(offset.y))
if room.x < room.y:
    way_out = Vector2(1 if offset.x > 0 else -1, 0)
    gap = room.x
else:
    way_out = Vector2(0, 1 if offset.y > 0 else -1)
    gap = room.y
return Contact(a, b, -way_out, radius + gap, a.pos + way_out * gap)
# END TODO 1
