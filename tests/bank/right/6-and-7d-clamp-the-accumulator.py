"""Caps what is in the accumulator instead of what a frame may add."""

# TODO 6: run whole steps from the accumulator
accumulator = min(accumulator + frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    accumulator -= STEP
    steps += 1
    world.step(STEP)
# END TODO 6

# TODO 7d: run whole steps from the accumulator
accumulator += frame_seconds
if accumulator > MAX_STEPS * STEP:
    accumulator = MAX_STEPS * STEP
steps = 0
while not accumulator < STEP:
    space.step(STEP)
    steps = steps + 1
    accumulator = accumulator - STEP
# END TODO 7d
