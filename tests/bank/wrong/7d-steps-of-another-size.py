"""Runs the right number of steps, each of 1/60 s."""

# TODO 7d: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    space.step(1 / 60)
    accumulator -= STEP
    steps += 1
# END TODO 7d
