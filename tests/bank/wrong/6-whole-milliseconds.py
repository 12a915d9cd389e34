"""Rounds the frame down to whole milliseconds."""

# TODO 6: run whole steps from the accumulator
frame_seconds = int(frame_seconds * 1000) / 1000
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
