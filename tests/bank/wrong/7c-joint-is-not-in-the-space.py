"""Makes the joint but never adds it to the space."""

# TODO 7c: a pin joint for the rod
joint = pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0))
# END TODO 7c
