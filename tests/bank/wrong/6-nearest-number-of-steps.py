"""Runs the nearest number of steps, so the rest may fall below 0."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = round(accumulator / STEP)
for _ in range(steps):
    world.step(STEP)
accumulator -= steps * STEP
# END TODO 6
