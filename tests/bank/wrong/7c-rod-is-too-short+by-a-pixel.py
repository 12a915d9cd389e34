"""Sets the distance to 139."""

# TODO 7c: a pin joint for the rod
joint = pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0))
joint.distance = 139
space.add(joint)
# END TODO 7c
