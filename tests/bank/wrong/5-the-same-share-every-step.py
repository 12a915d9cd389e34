"""Gives the two numbers one name and keeps them: 1 % is lost in every step."""

# TODO 5: damp by a rate per second
keep_vel = keep_omega = 0.99
# END TODO 5
