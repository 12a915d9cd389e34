"""An endless stream of rests, of which it takes those above 0."""

# TODO 6: run whole steps from the accumulator
from itertools import accumulate, repeat, takewhile

full = accumulator + min(frame_seconds, MAX_FRAME)
left = [full]
for rest in takewhile(lambda t: t >= 0, accumulate(repeat(-STEP), initial=full)):
    if rest != full:
        world.step(STEP)
    left.append(rest)
accumulator = left[-1]
steps = len(left) - 2
# END TODO 6

# TODO 7d: run whole steps from the accumulator
from itertools import accumulate, repeat, takewhile

full = accumulator + min(frame_seconds, MAX_FRAME)
left = [full]
for rest in takewhile(lambda t: t >= 0, accumulate(repeat(-STEP), initial=full)):
    if rest != full:
        space.step(STEP)
    left.append(rest)
accumulator = left[-1]
steps = len(left) - 2
# END TODO 7d
