"""Gives a step all the time in the accumulator instead of one STEP."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
if accumulator >= STEP:
    world.step(accumulator)
    accumulator = 0.0
    steps = 1
# END TODO 6
