"""Known mistakes in TODO B1, by what is seen of them at each moment that the checks look at."""

from collections.abc import Callable, Collection
from functools import partial

from grader.checks.todo_b1.checks import (
    AFTER_A_HIT,
    AFTER_A_PUSH,
    AFTER_A_SPIN,
    AFTER_THE_AIR,
    ANOTHER_HIT,
    AT_FIRST,
    AT_REST,
    CARRIED_AWAY,
    CHEAP,
    CREEPING,
    FLOOR_GONE,
    FLYING,
    IN_TURN,
    LONG_AT_REST,
    ON_A_ROD,
    ON_A_SPRING,
    ONE_OF_TWO_GONE,
    ROLLING,
    SPINNING,
    STATIC,
)
from grader.judge.misconceptions import Undecided, mistake, truth

HELD, ANEW = (ON_A_ROD, ON_A_SPRING), (AFTER_A_PUSH, AFTER_THE_AIR)
HIT, LEFT = (AFTER_A_HIT, AFTER_A_SPIN), (FLOOR_GONE, CARRIED_AWAY, ONE_OF_TWO_GONE)
AWAKE = (AT_FIRST, STATIC, FLYING, ROLLING, SPINNING, *HELD, *ANEW, *HIT, *LEFT)
ASLEEP = (AT_REST, LONG_AT_REST, CREEPING, ANOTHER_HIT, IN_TURN, CHEAP)
RIGHT = dict.fromkeys(AWAKE, False) | dict.fromkeys(ASLEEP, True)

truth("sleep", RIGHT.__getitem__)

known = partial(mistake, "B1", "sleep")


def wrong_at(*moments: str, unsure: Collection[str] = ()) -> Callable[[str], bool]:
    """Asleep for awake or the other way round at these moments, and perhaps at the unsure ones."""

    def model(when: str) -> bool:
        if when in unsure:
            raise Undecided
        return RIGHT[when] != (when in moments)

    return model


known(
    "sleeps-too-soon",
    "It sleeps before half a second is over: still_for counts seconds, dt more in each step.",
    wrong_at(AT_FIRST, unsure=(*ANEW, *LEFT, *HIT)),
)
known(
    "sleeps-at-the-top-of-a-throw",
    "A body that touches nothing cannot rest, however slow it is.",
    wrong_at(FLYING, unsure=(AFTER_THE_AIR,)),
)
known(
    "sleeps-while-it-spins",
    "A body that spins moves, even if its centre does not: speed() looks at both.",
    wrong_at(SPINNING),
)
known(
    "sleeps-on-its-rod",
    "What hangs on a rod or a spring never sleeps: see held.",
    wrong_at(*HELD),
)
known(
    "the-time-never-begins-anew",
    "Time at rest is added up over pauses: set still_for to 0 in every step in which it moves.",
    wrong_at(AFTER_A_PUSH, unsure=(AFTER_THE_AIR,)),
)
known(
    "sleeps-through-a-hit",
    "A sleeper sleeps on when something faster than WAKING touches it.",
    wrong_at(*HIT),
)
known(
    "one-hit-wakes-all",
    "A hit wakes those that nothing has touched, too: only who is touched wakes.",
    wrong_at(ANOTHER_HIT),
)
known(
    "floats-when-its-support-leaves",
    "A sleeper stays in the air when what it lay on has gone: see has_left(), which is asked about "
    "each body of body.support; fall_asleep() fills that.",
    wrong_at(FLOOR_GONE, CARRIED_AWAY, unsure=(ONE_OF_TWO_GONE,)),
)
known(
    "an-awake-neighbour-wakes",
    "A neighbour that is awake wakes it, though it lies still: a pile in which bodies come to rest "
    "one after another never sleeps. Only a body that moves wakes another one.",
    wrong_at(IN_TURN, unsure=(AT_REST, CHEAP, *LEFT)),
)
known(
    "never-wakes",
    "Nothing wakes a sleeper: wake() is for one that something faster than WAKING touches, or that "
    "has lost a body of its support.",
    wrong_at(*HIT, *LEFT),
)
known(
    "a-static-body-sleeps",
    "A static body falls asleep as well: only what can move sleeps, see world.moving_bodies().",
    wrong_at(STATIC, unsure={*RIGHT} - {STATIC}),
)
known(
    "sleeps-at-once",
    "It sleeps at once: a body falls asleep only when its still_for is above SLEEP_AFTER.",
    wrong_at(AT_FIRST, unsure={*RIGHT} - {AT_FIRST}),
)
