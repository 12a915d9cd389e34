"""Counts to MAX_STEPS and lets go of the whole steps that are left over."""

# TODO 6: run whole steps from the accumulator
accumulator += frame_seconds
steps = 0
while accumulator >= STEP and steps < MAX_STEPS:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
accumulator %= STEP
# END TODO 6

# TODO 7d: run whole steps from the accumulator
accumulator += frame_seconds
for steps in range(MAX_STEPS + 1):
    if accumulator < STEP or steps == MAX_STEPS:
        break
    space.step(STEP)
    accumulator -= STEP
accumulator = min(accumulator, STEP - 1e-9)
# END TODO 7d
