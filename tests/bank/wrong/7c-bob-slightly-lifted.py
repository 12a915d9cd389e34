"""Moves the bob to y 91 after the joint is made."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0)))
bob.position = (840, 91)
# END TODO 7c
