"""As many steps as the frame pays for: nothing is kept for the next one, and there is no cap."""

# TODO 6: run whole steps from the accumulator
steps = int(frame_seconds / STEP)
for _ in range(steps):
    world.step(STEP)
# END TODO 6
