"""advance calls itself for each further step."""

# TODO 6: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_FRAME)
if accumulator < STEP:
    return accumulator, 0
world.step(STEP)
rest, steps = advance(world, accumulator - STEP, 0.0)
return rest, steps + 1
# END TODO 6

# TODO 7d: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_FRAME)
if accumulator < STEP:
    return accumulator, 0
space.step(STEP)
rest, steps = advance(space, accumulator - STEP, 0.0)
return rest, steps + 1
# END TODO 7d
