"""Exact time, in fractions."""

# TODO 6: run whole steps from the accumulator
from fractions import Fraction
purse = Fraction(accumulator) + min(Fraction(frame_seconds), Fraction(MAX_FRAME))
steps = purse // Fraction(STEP)  # rounds down
for _ in range(steps):
    world.step(STEP)
accumulator = float(purse - steps * Fraction(STEP))
# END TODO 6
