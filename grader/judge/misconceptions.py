"""Name the mistake: hold a model of each known one against every answer of the submission.

A mistake is named only if its model gives *every* observed answer it speaks about, and the right
model does not. Nothing is guessed from how the code looks.
"""

import importlib
import math
from collections.abc import Callable, Collection, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from typing import Any

from grader.judge.lab import Observation
from grader.judge.recorded import Answers, Recorded, key, load_recorded
from grader.judge.rubric import CHECKS, load_rubric

Model = Callable[..., Any]
Parts = dict[str, list[int]]


class Undecided(Exception):
    """Raised by a model that has no one answer to these inputs, such as a tie of two faces."""


@dataclass(frozen=True)
class Mistake:
    todo: str
    id: str
    meaning: str  # the sentence a student reads
    about: str
    model: Model
    apart: bool = True  # whether it may be made in one part of an answer alone


known_mistakes: list[Mistake] = []
right_models: dict[str, Model] = {}
trait_models: dict[
    str, Model
] = {}  # what a question is like, in words, by what may tell it from others
part_names: dict[str, Parts] = {}
separate_questions: set[str] = (
    set()
)  # observations of which a mistake may be made in one part alone


def truth(
    about: str,
    model: Model,
    like: Model | None = None,
    of: Parts | None = None,
    apart: bool = False,
) -> None:
    """Register the right model of the observations called `about`.

    `like` says what a question is like: a dict of clauses such as {"place": "the centre is inside
    the box"}, in the order in which a mistake is looked for. By what begins with _ none is looked
    for: it tells nothing but where answers are wrong. `of` names the parts of an answer, by
    the positions of their numbers in it; no positions are all of them. Where each part has code of
    its own, they are `apart`, and a mistake may be made in one of them alone.
    """
    right_models[about] = model
    if like is not None:
        trait_models[about] = like
    if of is not None:
        part_names[about] = of
    if apart:
        separate_questions.add(about)


def mistake(
    todos: str, about: str, name: str, meaning: str, *models: Model, apart: bool = True
) -> None:
    """Register a mistake: what each model gives for the observations called `about`.

    One model that explains the answers is enough. Of several TODOs the ids are separated by spaces.
    Where two mistakes explain the same answers, the one registered first is named. One that is not
    `apart` is in all of an answer, whatever `truth` says of its parts. A file that says
    the first two arguments often makes a partial of this function.
    """
    for model in models:
        for todo in todos.split():
            known_mistakes.append(Mistake(todo, name, meaning, about, model, apart))


def always(answer: Any) -> Model:
    """Return the model that gives the same answer whatever is asked."""
    return lambda *inputs: answer


@cache
def load_known(todo: str) -> None:
    """Import a TODO's models, which are in `mistakes.py` beside its checks.

    A student's copy has what all models answer, as far as it was recorded.
    """
    table = load_recorded()
    if table is not None:
        register_recorded(table, todo)
        return
    for each in load_rubric().todos:
        if each.id == todo and (CHECKS / each.folder / "mistakes.py").exists():
            importlib.import_module(f"grader.checks.{each.folder}.mistakes")


def register_recorded(table: Recorded, todo: str) -> None:
    for each in table.mistakes:
        if each.todo == todo:
            model = answer_from(each.answers)
            mistake(todo, each.about, each.id, each.meaning, model, apart=each.apart)
    for about, answers in table.right.items():
        like = answer_from(table.traits[about]) if about in table.traits else None
        truth(about, answer_from(answers), like, table.parts.get(about), about in table.separate)


def answer_from(answers: Answers) -> Model:
    """Return the model that gives these answers, and is undecided where there is none."""

    def model(*inputs: Any) -> Any:
        try:
            return answers[key(inputs)]
        except KeyError:
            raise Undecided from None

    return model


def name_mistake(todo: str, observations: Sequence[Observation]) -> Mistake | None:
    """Return the known mistake that explains every answer, or None.

    A student's copy sees less, so it names one only if no other explains as much.
    """
    load_known(todo)
    if says_nothing(observations):
        return None
    mine = [each for each in known_mistakes if each.todo == todo]
    found = [each for each in mine if explains(each, observations)]
    fits = {(each.id, each.about) for each in found}
    asked = {each.about for each in observations}
    speaks = {(each.id, each.about) for each in mine if each.about in asked}
    denied = {id for id, about in speaks - fits}  # other answers would show it, and do not
    found = [each for each in found if each.id not in denied]
    if load_recorded() is not None and len(simplest({each.id for each in found})) > 1:
        return None
    return found[0] if found else None


def says_nothing(observations: Sequence[Observation]) -> bool:
    """Return whether all answers are missing where some of several parts are due.

    Many a mistake leaves none, and so does code that never comes to its answer.
    """
    asked = [each for each in observations if each.about in part_names]
    return bool(asked) and all(each.answer is None for each in asked)


def simplest(ids: Collection[str]) -> list[str]:
    """Drop the ids of two mistakes, `one+other`, one of which is there alone."""
    return [each for each in ids if "+" not in each or not set(each.split("+")) & set(ids)]


def predict(model: Model, inputs: tuple[Any, ...]) -> Any:
    """Return what a model gives; raise Undecided too where it divides by 0 or overflows."""
    try:
        return model(*inputs)
    except ArithmeticError:
        raise Undecided from None


def explains(each: Mistake, observations: Iterable[Observation]) -> bool:
    told_apart = False
    for seen in observations:
        if seen.about != each.about:
            continue
        try:
            predicted = predict(each.model, seen.inputs)
        except Undecided:
            continue
        if not are_close(predicted, seen.answer):
            return False
        try:
            told_apart = told_apart or not are_close(
                predict(right_models[each.about], seen.inputs), seen.answer
            )
        except Undecided:
            continue
    return told_apart


def are_close(first: Any, second: Any, tolerance: float = 1e-6) -> bool:
    """Return whether two answers are equal up to rounding, whatever the shape."""
    if isinstance(first, int | float) and isinstance(second, int | float):
        with suppress(OverflowError):  # a whole number larger than any float
            return math.isclose(first, second, rel_tol=tolerance, abs_tol=tolerance)
    if isinstance(first, tuple | list) and isinstance(second, tuple | list):
        return len(first) == len(second) and all(
            are_close(a, b, tolerance) for a, b in zip(first, second, strict=True)
        )
    return bool(first == second)
