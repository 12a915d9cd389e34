"""Forgets to multiply by STEP: the cap is 8 seconds instead of 8 steps."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
