"""Known mistakes in TODO B5, as models of where a body is drawn."""

from grader.checks import exact
from grader.checks.exact import Pair, Place
from grader.judge.misconceptions import mistake, truth


def place(before: Place, now: Place, share: float) -> Pair:
    """So much of the way from one place to the other."""
    x, y, _ = exact.part_of_the_way(before, now, share)
    return x, y


truth("between")(place)


@mistake(
    "B5",
    "share-turned-round",
    "The share is turned round: with 0 a body is where it was before, with 1 where it is now.",
    about="between",
)
def turned_round(before: Place, now: Place, share: float) -> Pair:
    return place(now, before, share)


@mistake(
    "B5",
    "always-one-step-behind",
    "The body is drawn where it was before the step, whatever the share.",
    about="between",
)
def one_step_behind(before: Place, now: Place, share: float) -> Pair:
    return before[:2]


@mistake(
    "B5",
    "looks-ahead",
    "The body is drawn ahead of where it is; nobody knows yet what it will hit there.",
    about="between",
)
def looks_ahead(before: Place, now: Place, share: float) -> Pair:
    (x, y), (then_x, then_y) = now[:2], place(before, now, share)
    return x + then_x - before[0], y + then_y - before[1]


@mistake(
    "B5",
    "always-half-way",
    "The body is drawn half-way, whatever the share.",
    about="between",
)
def half_way(before: Place, now: Place, share: float) -> Pair:
    return place(before, now, 0.5)
