"""Gives the anchors in the other order than the bodies."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PinJoint(space.static_body, bob, (0, 0), (700, 90)))
# END TODO 7c
