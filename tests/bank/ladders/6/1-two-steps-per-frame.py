"""Takes every frame for 1/60 s."""

# TODO 6: run whole steps from the accumulator
steps = 2
for _ in range(steps):
    world.step(STEP)
# END TODO 6
