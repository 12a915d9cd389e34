"""Lowers the solver's passes after a slow frame."""

# TODO 7d: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_FRAME)
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
if frame_seconds > MAX_FRAME:
    space.iterations = 5
# END TODO 7d
