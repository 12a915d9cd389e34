"""Empties the accumulator after each frame: the time left over is lost."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
accumulator = 0.0
# END TODO 6
