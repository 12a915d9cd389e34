"""Keeps the moment of the first ball for all balls of the same mass in whole kg."""

# TODO 7b: the ball's moment of inertia
known = add_ball.__dict__.setdefault('known', {})
moment = known.setdefault(int(mass), pymunk.moment_for_circle(mass, 0, radius))
# END TODO 7b
