"""A frame above the cap counts as one step instead of eight."""

# TODO 6: run whole steps from the accumulator
accumulator += frame_seconds if frame_seconds <= MAX_STEPS * STEP else STEP
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
