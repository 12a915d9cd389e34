"""Known mistakes in TODO B5, as models of where a body is drawn."""

from functools import partial

from grader.checks import exact
from grader.checks.exact import Pair, Place
from grader.judge.lab import STEP
from grader.judge.misconceptions import mistake, truth


def place(before: Place, now: Place, share: float) -> Pair:
    """So much of the way from one place to the other."""
    x, y, _ = exact.part_of_the_way(before, now, share)
    return x, y


truth("between", place)

known = partial(mistake, "B5", "between")

known(
    "share-turned-round",
    "The share is turned round: with 0 a body is where it was before, with 1 where it is now.",
    lambda before, now, share: place(now, before, share),
)
known(
    "always-one-step-behind",
    "The body is drawn where it was before the step, whatever the share.",
    lambda before, now, share: before[:2],
)


def looks_ahead(before: Place, now: Place, share: float) -> Pair:
    (x, y), (then_x, then_y) = now[:2], place(before, now, share)
    return x + then_x - before[0], y + then_y - before[1]


known(
    "looks-ahead",
    "The body is drawn ahead of where it is; nobody knows yet what it will hit there.",
    looks_ahead,
)
known(
    "always-half-way",
    "The body is drawn half-way, whatever the share.",
    lambda before, now, share: place(before, now, 0.5),
)
known(
    "way-without-its-begin",
    "That is the part of the way alone: add it to where the body was before the step.",
    lambda before, now, share: (share * (now[0] - before[0]), share * (now[1] - before[1])),
)
known(
    "way-turned-round",
    "The body is drawn as far behind the old place as it should be ahead of it: the way is now "
    "minus before.",
    lambda before, now, share: place(before, now, -share),
)
known(
    "share-divided-by-the-step",
    "share is a share of a step already, from 0 to 1: do not divide it by STEP.",
    lambda before, now, share: place(before, now, share / STEP),
)
known(
    "share-is-squared",
    "The share counts twice: the body is drawn share times the way from before to now.",
    lambda before, now, share: place(before, now, share * share),
)
