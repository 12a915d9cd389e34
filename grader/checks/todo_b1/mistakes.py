"""Known mistakes in TODO B1, by their effects at each moment that the checks observe."""

from collections.abc import Callable, Collection

from grader.checks.mistakes import Models, register
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
from grader.judge.explain.misconceptions import Kind, Undecided, kinds

HELD, ANEW = (ON_A_ROD, ON_A_SPRING), (AFTER_A_PUSH, AFTER_THE_AIR)
HIT, LEFT = (AFTER_A_HIT, AFTER_A_SPIN), (FLOOR_GONE, CARRIED_AWAY, ONE_OF_TWO_GONE)
AWAKE = (AT_FIRST, STATIC, FLYING, ROLLING, SPINNING, *HELD, *ANEW, *HIT, *LEFT)
ASLEEP = (AT_REST, LONG_AT_REST, CREEPING, ANOTHER_HIT, IN_TURN, CHEAP)
RIGHT = dict.fromkeys(AWAKE, False) | dict.fromkeys(ASLEEP, True)

kinds["sleep"] = Kind(RIGHT.__getitem__)


def wrong_at(*moments: str, unsure: Collection[str] = ()) -> Callable[[str], bool]:
    """Return the model with wrong answers at these moments, and perhaps at the unsure ones."""

    def model(when: str) -> bool:
        if when in unsure:
            raise Undecided
        return RIGHT[when] != (when in moments)

    return model


MODELS: Models = (
    ("sleeps-too-soon", wrong_at(AT_FIRST, unsure=(*ANEW, *LEFT, *HIT))),
    ("sleeps-at-the-top-of-a-throw", wrong_at(FLYING, unsure=(AFTER_THE_AIR,))),
    ("sleeps-while-it-spins", wrong_at(SPINNING)),
    ("sleeps-on-its-rod", wrong_at(*HELD)),
    ("the-time-never-begins-anew", wrong_at(AFTER_A_PUSH, unsure=(AFTER_THE_AIR,))),
    ("sleeps-through-a-hit", wrong_at(*HIT)),
    ("one-hit-wakes-all", wrong_at(ANOTHER_HIT)),
    (
        "floats-when-its-support-leaves",
        wrong_at(FLOOR_GONE, CARRIED_AWAY, unsure=(ONE_OF_TWO_GONE,)),
    ),
    ("an-awake-neighbour-wakes", wrong_at(IN_TURN, unsure=(AT_REST, CHEAP, *LEFT))),
    ("never-wakes", wrong_at(*HIT, *LEFT)),
    ("a-static-body-sleeps", wrong_at(STATIC, unsure={*RIGHT} - {STATIC})),
    ("sleeps-at-once", wrong_at(AT_FIRST, unsure={*RIGHT} - {AT_FIRST})),
)
register("B1", "sleep", MODELS)
