"""Lets a frame add one step at most: slow motion below 120 frames a second."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
