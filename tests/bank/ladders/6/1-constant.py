"""Two steps per frame: right at 60 frames a second."""

# TODO 6: run whole steps from the accumulator
steps = 2
for _ in range(steps):
    world.step(STEP)
# END TODO 6
