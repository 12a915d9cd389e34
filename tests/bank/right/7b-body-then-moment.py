"""From a shape with a mass: lets pymunk compute the moment from the shape."""

# TODO 7b: the ball's moment of inertia
probe = pymunk.Body()
probe_shape = pymunk.Circle(probe, radius)
probe_shape.mass = mass
moment = probe_shape.moment
# END TODO 7b
