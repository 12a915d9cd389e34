"""Name a known mistake, by comparing its model with every answer of the submission.

A mistake is named only if its model gives *every* answer to its kind of question, and the right
model does not. The text of the code plays no part.
"""

import importlib
import math
from collections.abc import Callable, Collection, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from grader.judge.lab import Observation
from grader.judge.recorded import Answers, RecordedAnswers, key, load_recorded
from grader.judge.rubric import CHECKS, load_rubric

Model = Callable[..., Any]
Parts = dict[str, list[int]]


class Undecided(Exception):
    """Raised by a model without a unique answer to these inputs, such as a tie of two faces."""


@dataclass(frozen=True)
class Mistake:
    todo: str
    id: str
    meaning: str  # the sentence a student reads
    about: str  # the kind of question
    model: Model
    apart: bool = True  # whether it may affect a single part of an answer


def no_traits(*inputs: Any) -> dict[str, str]:
    return {}


@dataclass(frozen=True)
class Kind:
    """A kind of question.

    `traits` describes a question by a dict of clauses, such as {"place": "the centre is inside the
    box"}. Mistakes are sought among questions that share a trait, in this order. A trait that
    begins with _ only helps to locate wrong answers. `parts` maps the name of each part of an
    answer to the positions of its numbers; no positions mean all. `apart`: separate code computes
    the parts, so a mistake may affect only one.
    """

    right: Model
    traits: Model = no_traits
    parts: Parts = field(default_factory=dict)
    apart: bool = False


known_mistakes: list[Mistake] = []
kinds: dict[str, Kind] = {}  # by their names


def mistake(
    todos: str, about: str, name: str, meaning: str, *models: Model, apart: bool = True
) -> None:
    """Register a mistake by models; it is found if one of them explains the answers.

    Several TODOs are separated by spaces. If two mistakes explain the same answers, the first one
    is named. With `apart` False, it never affects a single part of an answer, even if its kind of
    question allows that.
    """
    for model in models:
        for todo in todos.split():
            known_mistakes.append(Mistake(todo, name, meaning, about, model, apart))


def always(answer: Any) -> Model:
    """Return the model that gives the same answer to every question."""
    return lambda *inputs: answer


@cache
def load_known(todo: str) -> None:
    """Import a TODO's models from `mistakes.py` beside its checks.

    A student's copy has recorded answers instead of models.
    """
    table = load_recorded()
    if table is not None:
        register_recorded(table, todo)
        return
    for each in load_rubric().todos:
        if each.id == todo and (CHECKS / each.folder / "mistakes.py").exists():
            importlib.import_module(f"grader.checks.{each.folder}.mistakes")


def register_recorded(table: RecordedAnswers, todo: str) -> None:
    for each in table.mistakes:
        if each.todo == todo:
            model = answer_from(each.answers)
            mistake(todo, each.about, each.id, each.meaning, model, apart=each.apart)
    for about, kind in table.kinds.items():
        right, traits = answer_from(kind.right), answer_from(kind.traits)
        kinds[about] = Kind(right, traits, kind.parts, kind.apart)


def answer_from(answers: Answers) -> Model:
    """Return the model that knows these answers, and is undecided about other questions."""

    def model(*inputs: Any) -> Any:
        try:
            return answers[key(inputs)]
        except KeyError:
            raise Undecided from None

    return model


def name_mistake(todo: str, observations: Sequence[Observation]) -> Mistake | None:
    """Return the known mistake that explains every answer, or None.

    A student's copy knows fewer answers, so it names a mistake only if no other explains as many.
    """
    load_known(todo)
    if says_nothing(observations):
        return None
    of_todo = [each for each in known_mistakes if each.todo == todo]
    found = [each for each in of_todo if explains(each, observations)]
    fits = {(each.id, each.about) for each in found}
    kinds = {each.about for each in observations}
    expected = {(each.id, each.about) for each in of_todo if each.about in kinds}
    denied = {id for id, _ in expected - fits}  # it would show in other answers, but does not
    found = [each for each in found if each.id not in denied]
    if load_recorded() is not None and len(keep_simplest({each.id for each in found})) > 1:
        return None
    return found[0] if found else None


def says_nothing(observations: Sequence[Observation]) -> bool:
    """Return whether all answers with several parts are missing, which fits many mistakes."""
    answers = [each.answer for each in observations if kinds[each.about].parts]
    return bool(answers) and all(each is None for each in answers)


def keep_simplest(ids: Collection[str]) -> list[str]:
    """Drop a combined id, `one+other`, if `one` or `other` is in the list too."""
    return [each for each in ids if "+" not in each or not set(each.split("+")) & set(ids)]


def predict(model: Model, inputs: tuple[Any, ...]) -> Any:
    """Return a model's answer; raises Undecided also if it divides by 0 or overflows."""
    try:
        return model(*inputs)
    except ArithmeticError:
        raise Undecided from None


def explains(mistake: Mistake, observations: Iterable[Observation]) -> bool:
    """Return whether a mistake gives all these answers, and the right model does not."""
    is_wrong = False
    for each in observations:
        if each.about != mistake.about:
            continue
        with suppress(Undecided):
            if not are_close(predict(mistake.model, each.inputs), each.answer):
                return False
            right = kinds[mistake.about].right
            is_wrong = is_wrong or not are_close(predict(right, each.inputs), each.answer)
    return is_wrong


def are_close(first: Any, second: Any, tolerance: float = 1e-6) -> bool:
    """Return whether two answers of any shape are equal up to rounding."""
    if isinstance(first, int | float) and isinstance(second, int | float):
        with suppress(OverflowError):  # a whole number larger than any float
            return math.isclose(first, second, rel_tol=tolerance, abs_tol=tolerance)
    if isinstance(first, tuple | list) and isinstance(second, tuple | list):
        return len(first) == len(second) and all(
            are_close(a, b, tolerance) for a, b in zip(first, second, strict=True)
        )
    return bool(first == second)
