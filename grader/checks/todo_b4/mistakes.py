"""Known mistakes in TODO B4, as models of what is counted.

Of balls and pegs: in so many steps in which one is thrown at the other ("throw"), lies against it
("touch") or is far from it again ("leave"). Of others: a ball at a ball, a ball at the ledge, a box
at a peg. And in a new space, after so many hits in the space before.
"""

from functools import partial

from grader.judge.misconceptions import Undecided, always, mistake, truth

truth("hits", lambda what, steps: int(what != "leave"))
truth("others", always([0, 0, 0]))
truth("afresh", always(0))

known_hits = partial(mistake, "B4", "hits")
known_others = partial(mistake, "B4", "others")

known_others(
    "counts-what-balls-hit",
    "Whatever a ball hits is counted: name both collision types, the ball's and the peg's.",
    always([2, 1, 0]),  # a touch of two balls is one of each
)
known_others(
    "counts-what-hits-pegs",
    "Whatever hits a peg is counted: name both collision types, the ball's and the peg's.",
    always([0, 0, 1]),
)
known_others(
    "counts-every-touch",
    "Whatever touches is counted: name both collision types, the ball's and the peg's.",
    always([1, 1, 1]),
)
known_others(
    "counts-between-balls",
    "Balls that hit balls are counted; the collision types are BALL and PEG.",
    always([1, 0, 0]),
)
known_hits(
    "counts-nothing",
    "No hit of a peg is counted: are begin itself and data handed to the space, for BALL and PEG?",
    always(0),
)


def every_step(what: str, steps: int) -> int:
    if what == "throw":  # the touch may last a step or two
        raise Undecided
    return steps if what == "touch" else 0


known_hits(
    "counts-every-step", "Every step of a touch is counted; only its begin is a hit.", every_step
)
known_hits(
    "counts-when-they-part",
    "The end of a touch is counted: what still touches has not been counted yet.",
    lambda what, steps: int(what != "touch"),
)
known_hits(
    "soft-touches-are-left-out",
    "A ball that comes to lie at a peg is not counted; a soft touch is a hit, too.",
    lambda what, steps: int(what == "throw"),
)
mistake(
    "B4",
    "afresh",
    "one-counter-for-all-spaces",
    "A new space goes on where the old one stopped: count in the data of this space.",
    lambda before: before,
)
