"""Divides by 1000 once more: almost nothing moves."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds / 1000, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
