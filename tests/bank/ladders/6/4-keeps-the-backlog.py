"""Runs MAX_STEPS steps a frame at the most, and leaves the rest for later."""

# TODO 6: run whole steps from the accumulator
accumulator += frame_seconds
steps = 0
while accumulator >= STEP and steps < MAX_STEPS:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
