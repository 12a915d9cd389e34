"""Pins the bob's centre to the place where it starts, so it never swings."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PivotJoint(space.static_body, bob, (840, 90)))
# END TODO 7c
