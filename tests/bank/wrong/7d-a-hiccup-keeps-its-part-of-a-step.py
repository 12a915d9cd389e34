"""Cuts what is in the accumulator, and puts back its part of a step: time that never was."""

# TODO 7d: run whole steps from the accumulator
accumulator += frame_seconds
if accumulator > MAX_FRAME:
    accumulator = MAX_FRAME + accumulator % STEP
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 7d
