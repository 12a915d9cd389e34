"""Takes a frame near a usual rate for one of exactly that rate."""

# TODO 7d: run whole steps from the accumulator
for rate in (30, 60, 120, 144):
    if abs(frame_seconds * rate - 1) < 0.05:
        frame_seconds = 1 / rate
accumulator += min(frame_seconds, MAX_FRAME)
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 7d
