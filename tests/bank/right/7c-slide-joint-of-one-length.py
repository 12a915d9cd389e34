"""A slide joint whose shortest and longest length are the same: a rod all the same."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.SlideJoint(space.static_body, bob, (700, 90), (0, 0), 140, 140))
# END TODO 7c
