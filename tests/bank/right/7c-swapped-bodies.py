"""Bob first, static body second."""

# TODO 7c: a pin joint for the rod
rod = pymunk.PinJoint(bob, space.static_body, anchor_a=(0, 0), anchor_b=(700, 90))
space.add(rod)
# END TODO 7c
