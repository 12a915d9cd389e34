"""A Vec2d for gravity, the disc's formula by hand, and the rod tied the other way round."""

# TODO 7a: gravity
down = pymunk.Vec2d(0, 1)
space.gravity = 980 * down
# END TODO 7a

# TODO 7b: the ball's moment of inertia
moment = mass * radius * radius / 2
# END TODO 7b

# TODO 7c: a pin joint for the rod
rod = pymunk.PinJoint(bob, space.static_body, anchor_b=(700, 90))
rod.collide_bodies = False
space.add(rod)
# END TODO 7c
