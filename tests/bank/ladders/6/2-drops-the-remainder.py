"""Whole steps of each frame, with the cap; what is left is thrown away."""

# TODO 6: run whole steps from the accumulator
steps = int(min(frame_seconds, MAX_STEPS * STEP) / STEP)
for _ in range(steps):
    world.step(STEP)
accumulator = 0.0
# END TODO 6
