"""Ties the rod to a static body of its own instead of the space's."""

# TODO 7c: a pin joint for the rod
hook = pymunk.Body(body_type=pymunk.Body.STATIC)
hook.position = 700, 90
space.add(hook, pymunk.PinJoint(hook, bob))
# END TODO 7c
