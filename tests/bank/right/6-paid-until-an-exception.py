"""Pays out step by step, until an exception says that the purse is empty."""

# TODO 6: run whole steps from the accumulator
class Empty(Exception):
    """The purse is empty."""

def pay(purse):
    if purse < STEP:
        raise Empty
    return purse - STEP

accumulator += min(frame_seconds, MAX_FRAME)
steps = 0
try:
    while True:
        accumulator = pay(accumulator)
        world.step(STEP)
        steps += 1
except Empty:
    pass
# END TODO 6
