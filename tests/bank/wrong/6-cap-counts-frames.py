"""Reads MAX_STEPS as a number of frames at 60 frames a second."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS / 60)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
