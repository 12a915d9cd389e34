"""Takes every frame near 1/60 s for one of exactly 1/60 s."""

# TODO 6: run whole steps from the accumulator
if abs(frame_seconds - 1 / 60) < 0.002:
    frame_seconds = 1 / 60
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
