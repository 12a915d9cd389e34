"""Counts the whole steps by a division, then runs them in a for loop."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = int(accumulator / STEP)
for _ in range(steps):
    world.step(STEP)
accumulator -= steps * STEP
# END TODO 6

# TODO 7d: run whole steps from the accumulator
whole, accumulator = divmod(accumulator + min(frame_seconds, MAX_STEPS * STEP), STEP)
steps = int(whole)
for _ in range(steps):
    space.step(STEP)
# END TODO 7d
