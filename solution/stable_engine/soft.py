"""Soft constraints: as stiff as the step allows, and stable at any stiffness."""

import math

SAME_DIRECTION = 0.9  # cosine; an impulse is dropped if its direction has turned further
SIMILAR = 0.7  # of the pace; while steps that vary are as long at times, the pace stays
LONGER = 1.5  # times the pace; while they are no longer, it stays
STEADY = 60  # steps in a row, after which it may shorten


def softness(hertz: float, zeta: float, h: float) -> tuple[float, float]:
    """Make a constraint a damped spring of this frequency and damping ratio, stable at any h.

    Returns (bias_rate, mass_scale): the share of a position error corrected per second, and the
    share of the rigid constraint's impulse to apply. Source: Erin Catto, "Solver2D", 2024.
    """
    omega = 2 * math.pi * hertz
    firmness = h * omega * (2 * zeta + h * omega)
    return h * omega**2 / (1 + firmness), firmness / (1 + firmness)


class Pace:
    """The pace: the length of substep that sets the stiffness when steps vary.

    A constraint is as stiff as the substep allows, so a long substep lets bodies overlap more. A
    short one after it would push them apart violently at its full stiffness. So the pace follows
    far longer substeps at once and shorter ones gradually, slowly enough for gravity to keep a
    rising pile together. A step may shorten it by the share `stiffening` of a substep.

    Each change of pace moves a pile at rest, as it changes the overlap that explains a load. So
    while steps vary, the pace stays. In equal steps, it is the substep in the end.
    """

    def __init__(self, stiffening: float) -> None:
        self.stiffening = stiffening
        self.h = 0.0  # s
        self.last = 0.0  # s, the substep of the last step
        self.steady = STEADY  # steps in a row that left it free to shorten
        self.slept = 0.0  # s, the longest pace at which a present sleeper fell asleep

    def follow(self, h: float) -> float:
        """Return the pace (s) of a step that takes substeps of h seconds."""
        if h > LONGER * self.h:
            self.h = h
        elif h != self.last and h > SIMILAR * self.h:
            self.steady = 0
        else:
            self.steady += 1
        self.last = h
        if self.steady > STEADY:
            self.h = max(h, self.h - self.stiffening * h)
        return self.h

    def awake_changed(self, anybody_sleeps: bool) -> None:
        """Return to the longest pace at which sleepers fell asleep, as they keep its overlap.

        It counts when they wake, however short steps have become.
        """
        self.h = max(self.h, self.slept)
        self.slept = self.h if anybody_sleeps else 0.0
