"""Lets a slow frame owe as many steps as it likes."""

# TODO 7d: run whole steps from the accumulator
accumulator += frame_seconds
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 7d
