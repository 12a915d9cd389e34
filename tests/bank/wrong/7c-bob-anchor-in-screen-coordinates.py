"""Gives the bob's anchor as a place in the window; it is relative to the bob."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PinJoint(space.static_body, bob, (700, 90), (840, 90)))
# END TODO 7c
