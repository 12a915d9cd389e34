"""Runs no step at all."""

# TODO 6: run whole steps from the accumulator
steps = 0
# END TODO 6
