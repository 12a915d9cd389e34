"""Runs a step in every frame, even where none is due."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
if steps == 0:
    world.step(STEP)
    steps = 1
    accumulator = max(accumulator - STEP, 0.0)
# END TODO 6
