"""Takes a pivot joint at the anchor, which nails the bob to its rod."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PivotJoint(space.static_body, bob, (700, 90)))
# END TODO 7c
