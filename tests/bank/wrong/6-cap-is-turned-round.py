"""Writes max for min, so that every frame counts as a slow one."""

# TODO 6: run whole steps from the accumulator
accumulator += max(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
