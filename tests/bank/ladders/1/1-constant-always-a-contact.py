"""Says the same of any circle and box."""

# TODO 1: find the contact of a circle and a box
return Contact(a, b, Vector2(0, 1), 1.0, Vector2(a.pos))
# END TODO 1
