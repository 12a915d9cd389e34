"""Sets a length of its own instead of the distance at the start."""

# TODO 7c: a pin joint for the rod
rod = pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0))
rod.distance = 100
space.add(rod)
# END TODO 7c
