"""Measures the rod from the corner of the window and leaves it that long."""

# TODO 7c: a pin joint for the rod
rod = pymunk.PinJoint(space.static_body, bob, (700, 90))
rod.distance = bob.position.length
space.add(rod)
# END TODO 7c
