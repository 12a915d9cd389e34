"""Takes the friction off the bob's shape."""

# TODO 7c: a pin joint for the rod
space.add(pymunk.PinJoint(space.static_body, bob, (700, 90), (0, 0)))
for shape in bob.shapes:
    shape.friction = 0.0
# END TODO 7c
