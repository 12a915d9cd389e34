"""Takes whole steps from the accumulator but makes each a sixtieth of a second."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(1 / 60)
    accumulator -= STEP
    steps += 1
# END TODO 6
