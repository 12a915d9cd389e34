"""PinJoint with collide_bodies = False."""

# TODO 7c: a pin joint for the rod
rod = pymunk.PinJoint(space.static_body, bob, anchor_a=(700, 90), anchor_b=(0, 0))
rod.collide_bodies = False
space.add(rod)
# END TODO 7c
