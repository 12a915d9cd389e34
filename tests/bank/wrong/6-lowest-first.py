"""Sorts the world's bodies by height before it runs the steps."""

# TODO 6: run whole steps from the accumulator
world.bodies.sort(key=lambda body: -body.pos.y)
accumulator += min(frame_seconds, MAX_STEPS * STEP)
steps = 0
while accumulator >= STEP:
    world.step(STEP)
    accumulator -= STEP
    steps += 1
# END TODO 6
