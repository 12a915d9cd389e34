"""A step may begin a billionth of it early, so that rounding loses none."""

# TODO 7d: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_FRAME)
steps = 0
while accumulator >= STEP * (1 - 1e-9):
    space.step(STEP)
    accumulator = max(accumulator - STEP, 0.0)
    steps += 1
# END TODO 7d
