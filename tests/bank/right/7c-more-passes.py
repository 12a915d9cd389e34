"""Sets space.iterations to 20."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0)))
space.iterations = 20
# END TODO 7c
