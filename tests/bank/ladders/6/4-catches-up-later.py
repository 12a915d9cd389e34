"""Eight steps in a frame at most, but what a slow frame owes is caught up in the next ones."""

# TODO 6: run whole steps from the accumulator
accumulator += frame_seconds
steps = 0
while accumulator >= STEP and steps < MAX_STEPS:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
