"""Hangs the rod on a body that moves and falls itself."""

# TODO 7c: a pin joint for the rod
hook = pymunk.Body(1, 100)
hook.position = (700, 90)
space.add(hook)
space.add(pymunk.PinJoint(hook, bob))
# END TODO 7c
