"""Pulls and does not push."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.SlideJoint(space.static_body, bob, (700, 90), (0, 0), 0, 140))
# END TODO 7c
