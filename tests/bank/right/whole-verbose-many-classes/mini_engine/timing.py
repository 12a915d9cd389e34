"""Time in fixed steps."""

from .settings import MAX_STEPS, STEP


class FixedStepClock:
    """An accumulator."""

    def __init__(self, accumulator=0.0, step=STEP, max_steps=MAX_STEPS):
        self.accumulator = accumulator
        self.step = step
        self.longest_frame = max_steps * step

    def add_frame(self, frame_seconds):
        self.accumulator += min(frame_seconds, self.longest_frame)

    def due(self):
        """Yield once for each step that is due."""
        while self.accumulator >= self.step:
            self.accumulator -= self.step
            yield self.step


def advance(world, accumulator, frame_seconds):
    """Returns (accumulator, steps run)."""
    clock = FixedStepClock(accumulator)
    clock.add_frame(frame_seconds)
    steps = 0
    for dt in clock.due():
        world.step(dt)
        steps += 1
    return clock.accumulator, steps
