"""Counts time in whole picoseconds."""

# TODO 6: run whole steps from the accumulator
PER_SECOND = 10**12
step_ticks = round(STEP * PER_SECOND)
ticks = round(accumulator * PER_SECOND) + round(min(frame_seconds, MAX_FRAME) * PER_SECOND)
steps, ticks = divmod(ticks, step_ticks)
for _ in range(steps):
    world.step(STEP)
accumulator = ticks / PER_SECOND
# END TODO 6
