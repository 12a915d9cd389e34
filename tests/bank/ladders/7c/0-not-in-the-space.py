"""The joint is made and not added."""

# TODO 7c: a pin joint for the rod
pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0))
# END TODO 7c
