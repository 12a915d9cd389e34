"""Max_force 8000: the rod gives way at the lowest point."""

# TODO 7c: a pin joint for the rod
joint = pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0))
joint.max_force = 8000
space.add(joint)
# END TODO 7c
