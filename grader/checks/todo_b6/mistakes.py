"""Known mistakes in TODO B6, by which keys give a heavy ball."""

from collections.abc import Callable

from grader.checks.mistakes import Models, register
from grader.checks.todo_b6.checks import CLICKS
from grader.judge.explain.misconceptions import Kind, always, kinds

HEAVY = 10.0


def heavy_where(held: Callable[[set[str]], bool]) -> Callable[[], list[float]]:
    """Return the model that drops a heavy ball when the held keys match."""
    return always([HEAVY if held(set(keys.split("+")) - {""}) else 1.0 for keys, _ in CLICKS])


LEFT, RIGHT = "left shift", "right shift"

kinds["heaviness"] = Kind(heavy_where(lambda keys: LEFT in keys or RIGHT in keys))

MODELS: Models = (
    ("always-heavy", heavy_where(lambda keys: True)),
    ("only-the-left-shift", heavy_where(lambda keys: LEFT in keys)),
    ("only-the-right-shift", heavy_where(lambda keys: RIGHT in keys)),
    ("both-shifts-at-once", heavy_where(lambda keys: keys == {LEFT, RIGHT})),
    ("nothing-else-held", heavy_where(lambda keys: keys in ({LEFT}, {RIGHT}, {LEFT, RIGHT}))),
    ("any-modifier", heavy_where(bool)),
    ("heavy-without-shift", heavy_where(lambda keys: LEFT not in keys and RIGHT not in keys)),
    ("shift-does-not-count", heavy_where(lambda keys: False)),
    (
        "control-for-shift",
        always([HEAVY if "ctrl" in keys else 1.0 for keys, _ in CLICKS[:-1]] + [1.0]),
    ),
)
register("B6", "heaviness", MODELS)
