"""Known mistakes in TODO B5, as models of where a body is drawn."""

from grader.checks import exact
from grader.checks.exact import Pair, Place
from grader.checks.mistakes import Models, register
from grader.judge.explain.misconceptions import Kind, kinds
from grader.judge.lab import STEP


def find_place(before: Place, now: Place, share: float) -> Pair:
    """Return the position at a `share` of the way from `before` to `now`."""
    x, y, _ = exact.part_of_the_way(before, now, share)
    return x, y


kinds["between"] = Kind(find_place)

MODELS: Models = (
    ("share-turned-round", lambda before, now, share: find_place(now, before, share)),
    ("always-one-step-behind", lambda before, now, share: before[:2]),
    ("looks-ahead", lambda before, now, share: find_place(before, now, 1 + share)),
    ("always-half-way", lambda before, now, share: find_place(before, now, 0.5)),
    (
        "way-without-its-begin",
        lambda before, now, share: (share * (now[0] - before[0]), share * (now[1] - before[1])),
    ),
    ("way-turned-round", lambda before, now, share: find_place(before, now, -share)),
    ("share-divided-by-the-step", lambda before, now, share: find_place(before, now, share / STEP)),
    ("share-is-squared", lambda before, now, share: find_place(before, now, share * share)),
)
register("B5", "between", MODELS)
