"""Known mistakes in TODO B1, by their effects at each moment that the checks observe."""

from collections.abc import Callable, Collection

from grader.checks.mistakes import Models, register
from grader.checks.todo_b1 import checks as at
from grader.judge.explain.misconceptions import Kind, Undecided, kinds

HELD, ANEW = (at.ON_A_ROD, at.ON_A_SPRING), (at.AFTER_A_PUSH, at.AFTER_THE_AIR)
HIT, LEFT = (at.AFTER_A_HIT, at.AFTER_A_SPIN), (at.FLOOR_GONE, at.CARRIED_AWAY, at.ONE_OF_TWO_GONE)
AWAKE = (at.AT_FIRST, at.STATIC, at.FLYING, at.ROLLING, at.SPINNING, *HELD, *ANEW, *HIT, *LEFT)
ASLEEP = (at.AT_REST, at.LONG_AT_REST, at.CREEPING, at.ANOTHER_HIT, at.IN_TURN, at.CHEAP)
RIGHT = dict.fromkeys(AWAKE, False) | dict.fromkeys(ASLEEP, True)

kinds["sleep"] = Kind(RIGHT.__getitem__)


def wrong_at(*moments: str, unsure: Collection[str] = ()) -> Callable[[str], bool]:
    """Return the model with wrong answers at these moments, undecided at the `unsure` ones."""

    def model(when: str) -> bool:
        if when in unsure:
            raise Undecided
        return RIGHT[when] != (when in moments)

    return model


MODELS: Models = (
    ("sleeps-too-soon", wrong_at(at.AT_FIRST, unsure=(*ANEW, *LEFT, *HIT))),
    ("sleeps-at-the-top-of-a-throw", wrong_at(at.FLYING, unsure=(at.AFTER_THE_AIR,))),
    ("sleeps-while-it-spins", wrong_at(at.SPINNING)),
    ("sleeps-on-its-rod", wrong_at(*HELD)),
    ("the-time-never-begins-anew", wrong_at(at.AFTER_A_PUSH, unsure=(at.AFTER_THE_AIR,))),
    ("sleeps-through-a-hit", wrong_at(*HIT)),
    ("one-hit-wakes-all", wrong_at(at.ANOTHER_HIT)),
    (
        "floats-when-its-support-leaves",
        wrong_at(at.FLOOR_GONE, at.CARRIED_AWAY, unsure=(at.ONE_OF_TWO_GONE,)),
    ),
    ("an-awake-neighbour-wakes", wrong_at(at.IN_TURN, unsure=(at.AT_REST, at.CHEAP, *LEFT))),
    ("never-wakes", wrong_at(*HIT, *LEFT)),
    ("a-static-body-sleeps", wrong_at(at.STATIC, unsure={*RIGHT} - {at.STATIC})),
    ("sleeps-at-once", wrong_at(at.AT_FIRST, unsure={*RIGHT} - {at.AT_FIRST})),
)
register("B1", "sleep", MODELS)
