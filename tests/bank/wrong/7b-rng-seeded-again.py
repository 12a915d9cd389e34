"""Seeds the rng by the radius: the next ball is always the same."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(mass, 0, radius)
if radius >= 19:
    rng.seed(radius)
# END TODO 7b
