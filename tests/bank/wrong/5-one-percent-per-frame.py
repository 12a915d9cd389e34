"""Makes 0.99 independent of the step, for 60 frames a second, and ignores the rates."""

# TODO 5: damp by a rate per second
keep_vel = keep_omega = 0.99 ** (60 * dt)
# END TODO 5
