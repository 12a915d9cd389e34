"""Caps the frame at one step, so slow frames run in slow motion."""

# TODO 7d: run whole steps from the accumulator
accumulator += min(frame_seconds, STEP)
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 7d
