"""Makes milliseconds of the frame time, as pygame counts it, while STEP is in seconds."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds * 1000, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
