"""A stiff DampedSpring instead of a rod."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.DampedSpring(space.static_body, bob, (700, 90), (0, 0), 140, 50000, 500))
# END TODO 7c
