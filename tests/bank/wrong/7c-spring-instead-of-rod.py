"""Hangs the bob on a soft spring."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.DampedSpring(space.static_body, bob, (700, 90), (0, 0), 140, 200, 10))
# END TODO 7c
