"""Takes one step as long as the frame, with the cap."""

# TODO 6: run whole steps from the accumulator
accumulator = 0.0
world.step(min(frame_seconds, MAX_STEPS * STEP))
steps = 1
# END TODO 6
