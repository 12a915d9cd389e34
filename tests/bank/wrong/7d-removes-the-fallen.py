"""Removes what has fallen below the window."""

# TODO 7d: run whole steps from the accumulator
accumulator += min(frame_seconds, MAX_FRAME)
steps = 0
while accumulator >= STEP:
    space.step(STEP)
    accumulator -= STEP
    steps += 1
for body in list(space.bodies):
    if body.position.y > HEIGHT + 100:
        space.remove(body, *body.shapes)
# END TODO 7d
