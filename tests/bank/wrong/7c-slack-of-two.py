"""A SlideJoint from 138 to 142."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.SlideJoint(space.static_body, bob, (700, 90), (0, 0), 138, 142))
# END TODO 7c
