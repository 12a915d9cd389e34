"""Takes every frame for 1/60 s."""

# TODO 7d: run whole steps from the accumulator
steps = 2
for _ in range(steps):
    space.step(STEP)
# END TODO 7d
