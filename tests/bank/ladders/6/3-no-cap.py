"""An accumulator without a cap."""

# TODO 6: run whole steps from the accumulator
accumulator += frame_seconds
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
