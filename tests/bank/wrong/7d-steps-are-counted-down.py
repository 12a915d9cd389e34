"""Takes one from the count for each step that runs."""

# TODO 7d: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps -= 1
# END TODO 7d
