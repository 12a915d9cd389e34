"""Steps once per frame, by whatever the frame took."""

# TODO 7d: run whole steps from the accumulator
space.step(min(frame_seconds, MAX_STEPS * STEP))
steps = 1
# END TODO 7d
