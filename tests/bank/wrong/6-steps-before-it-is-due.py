"""Goes on while anything is left, so that the accumulator falls below 0."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator > 0:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
