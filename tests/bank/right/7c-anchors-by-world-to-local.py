"""Anchors through world_to_local."""

# TODO 7c: a pin joint for the rod
ground = space.static_body
joint = pymunk.PinJoint(
    ground, bob, ground.world_to_local((700, 90)), bob.world_to_local(bob.position)
)
joint.error_bias = (1 - 0.1) ** 60
space.add(joint)
# END TODO 7c
