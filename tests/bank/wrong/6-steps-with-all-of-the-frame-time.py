"""Takes one step as long as the frame, however long that was."""

# TODO 6: run whole steps from the accumulator
accumulator = 0.0
world.step(frame_seconds)
steps = 1
# END TODO 6
