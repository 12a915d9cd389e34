"""Known mistakes in TODO B6, by which keys give a heavy ball."""

from collections.abc import Callable

from grader.checks.mistakes import known_in
from grader.checks.todo_b6.checks import CLICKS
from grader.judge.explain.misconceptions import always, truth

HEAVY = 10.0


def heavy_where(held: Callable[[set[str]], bool]) -> Callable[[], list[float]]:
    """Return the model that drops a heavy ball when the held keys match."""
    return always([HEAVY if held(set(keys.split("+")) - {""}) else 1.0 for keys, _ in CLICKS])


LEFT, RIGHT = "left shift", "right shift"

truth("heaviness", heavy_where(lambda keys: LEFT in keys or RIGHT in keys))

known = known_in("B6", "heaviness")

known("always-heavy", heavy_where(lambda keys: True))
known("only-the-left-shift", heavy_where(lambda keys: LEFT in keys))
known("only-the-right-shift", heavy_where(lambda keys: RIGHT in keys))
known("both-shifts-at-once", heavy_where(lambda keys: keys == {LEFT, RIGHT}))
known("nothing-else-held", heavy_where(lambda keys: keys in ({LEFT}, {RIGHT}, {LEFT, RIGHT})))
known("any-modifier", heavy_where(bool))
known("heavy-without-shift", heavy_where(lambda keys: LEFT not in keys and RIGHT not in keys))
known("shift-does-not-count", heavy_where(lambda keys: False))
known(
    "control-for-shift",
    always([HEAVY if "ctrl" in keys else 1.0 for keys, _ in CLICKS[:-1]] + [1.0]),
)
