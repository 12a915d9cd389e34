"""7a, 7b and 7c together in other words."""

# TODO 7a: gravity
gravity = 980  # px/s^2, y grows down
space.gravity = pymunk.Vec2d(0, 1) * gravity
# END TODO 7a


# TODO 7b: the ball's moment of inertia
area = 3.141592653589793 * radius**2
density = mass / area
moment = density * 3.141592653589793 * radius**4 / 2
# END TODO 7b


# TODO 7c: a pin joint for the rod
joint = pymunk.constraints.PinJoint(a=space.static_body, b=bob, anchor_a=(700.0, 90.0))
space.add(joint)
# END TODO 7c
