"""Sets the bob's moment to infinity."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0)))
bob.moment = float('inf')
# END TODO 7c
