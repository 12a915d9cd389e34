"""Predict a number: the answer of the student's own program in an individual case.

Each maker computes an answer in closed form, and runs the case in the student's program. If the two
differ by over a hundredth of the tolerance, the question is not asked.
"""

import math
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from grader.questions.program import CannotAsk, Program
from grader.questions.question import Question, Wrong
from grader.text import digits

SHARE = 0.02  # share of an answer: tolerance for rounding on paper only
AGREE = 0.01  # share of the tolerance: allowed difference of two ways to an answer
TRIES = 200  # draws until wrong answers differ from the right one

Draw = dict[str, int]


class Unsuited(Exception):
    """Raised if wrong answers do not differ enough: other numbers are drawn."""


@dataclass(frozen=True)
class Case:
    """A case: the answer, got in two ways, and wrong answers."""

    text: str
    answer: float  # in closed form
    measured: float  # the student's program's answer
    unit: str
    why: str
    wrong: Sequence[tuple[float, str]] = ()
    share: float = SHARE
    whole: bool = False  # a count: only this exact number is right


@dataclass(frozen=True)
class Maker:
    """A maker of one question about some TODOs, with numbers drawn from `draws`."""

    name: str
    todos: tuple[str, ...]
    draws: Mapping[str, Sequence[int]]
    find: Callable[[Program, Draw], Case]
    slot: int  # questions of a slot are equally difficult; a sheet has one of each slot

    def ask(self, program: Program, seed: str, points: int) -> Question:
        """Make the question for one student; raise CannotAsk if no draw suits."""
        rng = random.Random(f"{seed}/{self.name}")
        for _ in range(TRIES):
            draw = {name: rng.choice(few) for name, few in self.draws.items()}
            try:
                return make_question(self, self.find(program, draw), points)
            except Unsuited:
                continue
        raise CannotAsk(f"{TRIES} draws gave no numbers that tell right from wrong")


def maker(
    slot: int, todos: str, **draws: Sequence[int]
) -> Callable[[Callable[[Program, Draw], Case]], Maker]:
    """Make a maker of a function that computes one case."""

    def made(find: Callable[[Program, Draw], Case]) -> Maker:
        name = find.__name__.replace("_", "-")
        return Maker(name, tuple(todos.split()), draws, find, slot)

    return made


def make_question(each: Maker, found: Case, points: int) -> Question:
    """Make the question; raises Unsuited if a wrong answer would count as right.

    Raises CannotAsk if the two ways to the answer differ.
    """
    tolerance = 0.0 if found.whole else round_up(abs(found.answer) * found.share)
    agree = AGREE * tolerance or 1e-9
    if not math.isclose(found.answer, found.measured, rel_tol=0.0, abs_tol=agree):
        raise CannotAsk(
            f"closed form and their program differ: {digits(found.answer)} and "
            f"{digits(found.measured)} {found.unit}"
        )
    if any(abs(value - found.answer) <= 2 * tolerance for value, _ in found.wrong):
        raise Unsuited
    wrong: dict[float, Wrong] = {}  # the first of those that are too similar
    for value, why in found.wrong:
        if all(abs(value - other) > 2 * tolerance for other in wrong):
            wrong[value] = Wrong(digits(value), why)
    within = (
        "" if found.whole else f" Answers within ±{digits(tolerance)} {found.unit} are accepted."
    )
    return Question(
        each.name,
        "number",
        each.todos,
        f"{found.text}{within}",
        points,
        digits(found.answer),
        tolerance,
        found.unit,
        tuple(wrong.values()),
        found.why,
    )


def round_up(value: float) -> float:
    """Return the next larger number of two digits."""
    if value == 0:
        return 0.0
    power = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.ceil(value / power - 1e-9) * power:.3g}")
