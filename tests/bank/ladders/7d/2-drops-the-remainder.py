"""Whole steps of each frame, with the cap; what is left is thrown away."""

# TODO 7d: run whole steps from the accumulator
steps = int(min(frame_seconds, MAX_STEPS * STEP) / STEP)
for _ in range(steps):
    space.step(STEP)
accumulator = 0.0
# END TODO 7d
