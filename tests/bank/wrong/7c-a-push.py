"""Gives the bob a small first speed."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0)))
bob.velocity = (0, 5)
# END TODO 7c
