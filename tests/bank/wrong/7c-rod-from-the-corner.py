"""Leaves out the anchors, so the rod hangs from the window's corner."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PinJoint(space.static_body, bob))
# END TODO 7c
