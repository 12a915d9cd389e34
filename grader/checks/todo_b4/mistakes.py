"""Known mistakes in TODO B4, as models of what is counted.

A ball and a peg: some steps of "throw" (one hits the other), "touch" (it lies there) or "leave" (it
is away again). Other pairs: two balls, a ball and the ledge, a box and a peg. The last case is a
new space, after hits in another.
"""

from grader.checks.mistakes import Models, register
from grader.judge.explain.misconceptions import Kind, Undecided, always, kinds

kinds["hits"] = Kind(lambda what, steps: int(what != "leave"))
kinds["others"] = Kind(always([0, 0, 0]))
kinds["afresh"] = Kind(always(0))

OTHERS: Models = (
    ("counts-what-balls-hit", always([2, 1, 0])),  # a touch of two balls is one of each
    ("counts-what-hits-pegs", always([0, 0, 1])),
    ("counts-every-touch", always([1, 1, 1])),
    ("counts-between-balls", always([1, 0, 0])),
)
register("B4", "others", OTHERS)


def count_every_step(what: str, steps: int) -> int:
    if what == "throw":  # the touch may last a step or two
        raise Undecided
    return steps if what == "touch" else 0


HITS: Models = (
    ("counts-nothing", always(0)),
    ("counts-every-step", count_every_step),
    ("counts-when-they-part", lambda what, steps: int(what != "touch")),
    ("soft-touches-are-left-out", lambda what, steps: int(what == "throw")),
)
register("B4", "hits", HITS)
register("B4", "afresh", [("one-counter-for-all-spaces", lambda before: before)])
