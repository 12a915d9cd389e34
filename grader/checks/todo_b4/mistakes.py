"""Known mistakes in TODO B4, as models of what is counted.

A ball and a peg: some steps of "throw" (one hits the other), "touch" (it lies there) or "leave" (it
is away again). Other pairs: two balls, a ball and the ledge, a box and a peg. The last case is a
new space, after hits in another.
"""

from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import Undecided, always, truth

truth("hits", lambda what, steps: int(what != "leave"))
truth("others", always([0, 0, 0]))
truth("afresh", always(0))

known_hits = known_in("B4", "hits")
known_others = known_in("B4", "others")

known_others(
    "counts-what-balls-hit",
    always([2, 1, 0]),  # a touch of two balls is one of each
)
known_others("counts-what-hits-pegs", always([0, 0, 1]))
known_others("counts-every-touch", always([1, 1, 1]))
known_others("counts-between-balls", always([1, 0, 0]))
known_hits("counts-nothing", always(0))


@known_hits("counts-every-step")
def counts_every_step(what: str, steps: int) -> int:
    if what == "throw":  # the touch may last a step or two
        raise Undecided
    return steps if what == "touch" else 0


known_hits("counts-when-they-part", lambda what, steps: int(what != "touch"))
known_hits("soft-touches-are-left-out", lambda what, steps: int(what == "throw"))
known_in("B4", "afresh")("one-counter-for-all-spaces", lambda before: before)
