"""Says the rod's length instead of leaving it to the joint."""

# TODO 7c: a pin joint for the rod
anchor = pymunk.Vec2d(700, 90)
rod = pymunk.PinJoint(space.static_body, bob, anchor_a=anchor)
rod.distance = (bob.position - anchor).length
rod.max_force = float("inf")
space.add(rod)
# END TODO 7c
