"""Counts time in whole microseconds, of which a step has 8333 and a third."""

# TODO 6: run whole steps from the accumulator
saved = round(accumulator * 1_000_000) + round(min(frame_seconds, MAX_FRAME) * 1_000_000)
steps = 0
while saved >= 8333:
    world.step(STEP)
    saved -= 8333
    steps += 1
accumulator = saved / 1_000_000
# END TODO 6
# TODO 7d: run whole steps from the accumulator
us = int(round(1e6 * accumulator)) + int(round(1e6 * min(frame_seconds, MAX_FRAME)))
steps = us * 120 // 1_000_000
for _ in range(steps):
    space.step(STEP)
accumulator = us / 1e6 - steps * STEP
# END TODO 7d
