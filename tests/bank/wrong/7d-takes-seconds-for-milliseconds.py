"""Divides by 1000, which main has done already."""

# TODO 7d: run whole steps from the accumulator
accumulator += min(frame_seconds / 1000, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 7d
