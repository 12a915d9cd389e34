"""Pays 8 ms for each step."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= 0.008:
    world.step(STEP)
    accumulator -= 0.008
    steps += 1
# END TODO 6
