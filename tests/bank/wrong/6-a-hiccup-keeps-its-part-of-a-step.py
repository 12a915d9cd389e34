"""Cuts what is in the accumulator, and puts back its part of a step: time that never was."""

# TODO 6: run whole steps from the accumulator
accumulator += frame_seconds
if accumulator > MAX_STEPS * STEP:
    accumulator = MAX_STEPS * STEP + accumulator % STEP
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
