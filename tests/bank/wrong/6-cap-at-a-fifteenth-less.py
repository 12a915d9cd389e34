"""The cap is typed in as 0.066 s: a slow frame runs 7 steps."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, 0.066)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
