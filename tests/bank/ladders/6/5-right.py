"""Each frame adds MAX_FRAME at most."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_FRAME)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
