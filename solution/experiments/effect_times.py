"""How much of a step each declared effect takes just now, in the stable engine.

A clock is put around the hooks that the engine calls; nothing in the engine is changed. For prices
that are the same everywhere see effects.py, which counts opcodes.
"""

import time
from collections import Counter

HOOKS = (
    *("detect_hooks", "impact_hooks", "prepare_hooks", "force_hooks"),
    *("warm_start_hooks", "solve_hooks", "relax_hooks", "finish_hooks"),
)
SHARE = 0.3  # of a new measurement in the smoothed one


class EffectTimes:
    """The shares of the effects of an engine; of one whose effects cannot be told apart, none."""

    def __init__(self, engine):
        self.spent, self.shares = Counter(), {}
        self.stepped = 0.0  # s, in steps since the last measurement
        self.effects = engine.world.effects if engine.name == "stable" else {}
        for name in HOOKS if self.effects else ():
            hooks = getattr(engine.world, name)
            setattr(engine.world, name, [self.timed(hook) for hook in hooks])

    def timed(self, hook):
        """A hook that notes how long it takes."""
        owner = type(hook.__self__).__name__

        def run(*arguments):
            start = time.perf_counter()
            try:
                return hook(*arguments)
            finally:
                self.spent[owner] += time.perf_counter() - start

        return run

    def settle(self):
        """Work out the shares of what ran since the last time."""
        if not self.stepped:
            return
        for name in self.effects:
            share = self.spent[name] / self.stepped
            self.shares[name] = share + (1 - SHARE) * (self.shares.get(name, share) - share)
        self.spent.clear()
        self.stepped = 0.0
