"""The cap that is usual elsewhere: 0.25 s, which is 30 steps."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, 0.25)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
