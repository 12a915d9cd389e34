"""Accumulates, but a slow frame is simulated in full, and the steps are not counted."""

# TODO 6: run whole steps from the accumulator
accumulator += frame_seconds
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
# END TODO 6
