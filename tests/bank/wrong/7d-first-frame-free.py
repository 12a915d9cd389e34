"""The first call runs no step, and remembers that it was the first."""

# TODO 7d: run whole steps from the accumulator
if not hasattr(advance, "started"):
    advance.started = True
    frame_seconds = 0.0
accumulator += min(frame_seconds, MAX_FRAME)
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 7d
