"""Keeps the rest on the space, whatever accumulator is given."""

# TODO 7d: run whole steps from the accumulator
if not hasattr(space, "rest"):
    space.rest = accumulator
space.rest += min(frame_seconds, MAX_FRAME)
steps = 0
while space.rest >= STEP:
    space.step(STEP)
    space.rest -= STEP
    steps += 1
accumulator = space.rest
# END TODO 7d
