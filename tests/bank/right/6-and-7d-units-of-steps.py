"""Counts time in steps instead of seconds."""

# TODO 6: run whole steps from the accumulator
owed = accumulator / STEP + min(frame_seconds / STEP, MAX_STEPS)
steps = 0
while owed >= 1:
    world.step(STEP)
    owed -= 1
    steps += 1
accumulator = owed * STEP
# END TODO 6

# TODO 7d: run whole steps from the accumulator
owed = accumulator / STEP + min(frame_seconds / STEP, MAX_STEPS)
steps = 0
while owed >= 1:
    space.step(STEP)
    owed -= 1
    steps += 1
accumulator = owed * STEP
# END TODO 7d
