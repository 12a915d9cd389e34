"""Nothing is lost."""

# TODO 5: damp by a rate per second
keep_vel = keep_omega = 1.0
# END TODO 5
