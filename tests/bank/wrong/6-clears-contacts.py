"""Empties the world's contacts in frames that are too short for a step."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
if steps == 0:
    world.contacts = []
# END TODO 6
