"""Runs a long rest as a last, shorter step."""

# TODO 7d: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_FRAME)
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
if accumulator > STEP / 2:
    space.step(accumulator)
    accumulator = 0.0
    steps += 1
# END TODO 7d
