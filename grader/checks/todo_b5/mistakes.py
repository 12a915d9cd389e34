"""Known mistakes in TODO B5, as models of where a body is drawn."""

from grader.checks import exact
from grader.checks.exact import Pair, Place
from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import truth
from grader.judge.lab import STEP


def find_place(before: Place, now: Place, share: float) -> Pair:
    """Return the position at this share of the way from one to the other."""
    x, y, _ = exact.part_of_the_way(before, now, share)
    return x, y


truth("between", find_place)

known = known_in("B5", "between")

known("share-turned-round", lambda before, now, share: find_place(now, before, share))
known("always-one-step-behind", lambda before, now, share: before[:2])


@known("looks-ahead")
def looks_ahead(before: Place, now: Place, share: float) -> Pair:
    (x, y), (then_x, then_y) = now[:2], find_place(before, now, share)
    return x + then_x - before[0], y + then_y - before[1]


known("always-half-way", lambda before, now, share: find_place(before, now, 0.5))
known(
    "way-without-its-begin",
    lambda before, now, share: (share * (now[0] - before[0]), share * (now[1] - before[1])),
)
known("way-turned-round", lambda before, now, share: find_place(before, now, -share))
known("share-divided-by-the-step", lambda before, now, share: find_place(before, now, share / STEP))
known("share-is-squared", lambda before, now, share: find_place(before, now, share * share))
