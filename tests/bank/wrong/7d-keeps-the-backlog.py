"""Stops after MAX_STEPS steps but keeps the time, so the next frames run after it."""

# TODO 7d: run whole steps from the accumulator
accumulator += frame_seconds
steps = 0
while accumulator >= STEP and steps < MAX_STEPS:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 7d
