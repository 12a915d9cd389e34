"""Runs MAX_STEPS steps a frame at the most, and leaves the rest for later."""

# TODO 7d: run whole steps from the accumulator
accumulator += frame_seconds
steps = 0
while accumulator >= STEP and steps < MAX_STEPS:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 7d
