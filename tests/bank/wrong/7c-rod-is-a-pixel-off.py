"""Hangs the rod a pixel beside the hook."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PinJoint(space.static_body, bob, (701, 90), (0, 0)))
# END TODO 7c
