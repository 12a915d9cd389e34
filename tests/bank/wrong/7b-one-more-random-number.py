"""Draws a random number: later balls differ."""

# TODO 7b: the ball's moment of inertia
moment = pymunk.moment_for_circle(mass, 0, radius)
rng.random()
# END TODO 7b
