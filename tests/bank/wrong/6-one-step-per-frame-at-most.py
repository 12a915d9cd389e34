"""Writes if for while: one step per frame, though the time is there for more."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
if accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
