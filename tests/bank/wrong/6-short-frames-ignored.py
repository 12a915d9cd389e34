"""Frames below 2 ms add nothing."""

# TODO 6: run whole steps from the accumulator
if frame_seconds < 0.002:
    frame_seconds = 0.0
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
