"""Known mistakes in TODO B4, as models of what is counted.

Of balls and pegs: in so many steps in which one is thrown at the other ("throw") or lies against it
("touch"). Of others: a ball at a ball, a ball at the ledge, a box at a peg. And in a new space,
after so many hits in the space before.
"""

from grader.judge.misconceptions import Undecided, mistake, truth


@truth("hits")
def right_hits(what: str, steps: int) -> int:
    return 1


@truth("others")
def right_others() -> list[int]:
    return [0, 0, 0]


@truth("afresh")
def right_afresh(before: int) -> int:
    return 0


def wrong_others(name: str, meaning: str, *counts: int) -> None:
    mistake("B4", name, meaning, about="others")(lambda: list(counts))


wrong_others(
    "counts-what-balls-hit",
    "Whatever a ball hits is counted: name both collision types, the ball's and the peg's.",
    *(2, 1, 0),  # a touch of two balls is one of each
)
wrong_others(
    "counts-what-hits-pegs",
    "Whatever hits a peg is counted: name both collision types, the ball's and the peg's.",
    *(0, 0, 1),
)
wrong_others(
    "counts-every-touch",
    "Whatever touches is counted: name both collision types, the ball's and the peg's.",
    *(1, 1, 1),
)
wrong_others(
    "counts-between-balls",
    "Balls that hit balls are counted; the collision types are BALL and PEG.",
    *(1, 0, 0),
)


@mistake("B4", "counts-nothing", "No hit is counted: is begin handed to the space?", about="hits")
def nothing(what: str, steps: int) -> int:
    return 0


@mistake(
    "B4",
    "counts-every-step",
    "Every step of a touch is counted; only its begin is a hit.",
    about="hits",
)
def every_step(what: str, steps: int) -> int:
    if what == "throw":  # the touch may last a step or two
        raise Undecided
    return steps


@mistake(
    "B4",
    "counts-when-they-part",
    "The end of a touch is counted: what still touches has not been counted yet.",
    about="hits",
)
def when_they_part(what: str, steps: int) -> int:
    return 1 if what == "throw" else 0


@mistake(
    "B4",
    "one-counter-for-all-spaces",
    "A new space goes on where the old one stopped: count in the data of this space.",
    about="afresh",
)
def one_counter(before: int) -> int:
    return before
