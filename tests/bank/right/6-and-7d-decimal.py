"""Counts time as Decimals."""

# TODO 6: run whole steps from the accumulator
from decimal import Decimal

time = Decimal(accumulator) + Decimal(min(frame_seconds, MAX_FRAME))
steps = 0
while time >= Decimal(STEP):
    time -= Decimal(STEP)
    world.step(STEP)
    steps += 1
accumulator = float(time)
# END TODO 6

# TODO 7d: run whole steps from the accumulator
from decimal import Decimal

time = Decimal(accumulator) + Decimal(min(frame_seconds, MAX_FRAME))
steps = 0
while time >= Decimal(STEP):
    time -= Decimal(STEP)
    space.step(STEP)
    steps += 1
accumulator = float(time)
# END TODO 7d
