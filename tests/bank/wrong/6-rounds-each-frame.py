"""Turns each frame into the nearest number of steps and has no remainder at all."""

# TODO 6: run whole steps from the accumulator
steps = round(min(frame_seconds, MAX_STEPS * STEP) / STEP)
for _ in range(steps):
    world.step(STEP)
# END TODO 6
