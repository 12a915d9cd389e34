"""Naming the mistake: a model of each known one, held against every answer the submission gave.

A mistake is named only if its model gives *every* observed answer it speaks about, and the right
model does not. Nothing is guessed from how the code looks.
"""

import importlib
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from grader.judge.lab import Observation
from grader.judge.recorded import Answers, Recorded, key, load_recorded
from grader.judge.rubric import CHECKS, load_rubric

Model = Callable[..., Any]


class Undecided(Exception):
    """Raised by a model that has no one answer to these inputs, such as a tie of two faces."""


@dataclass(frozen=True)
class Mistake:
    todo: str
    id: str
    meaning: str  # the sentence a student reads
    about: str
    model: Model


known: list[Mistake] = []
right: dict[str, Model] = {}


def truth(about: str) -> Callable[[Model], Model]:
    """Register the right model of the observations called `about`."""

    def register(model: Model) -> Model:
        right[about] = model
        return model

    return register


def mistake(todo: str, name: str, meaning: str, *, about: str) -> Callable[[Model], Model]:
    """Register a wrong model: what comes out of the observations `about` for this mistake."""

    def register(model: Model) -> Model:
        known.append(Mistake(todo, name, meaning, about, model))
        return model

    return register


@cache
def load_known(todo: str) -> None:
    """Import a TODO's models: they stand beside its checks, as mistakes_N for todo_N.

    A student's copy has what all models answer, as far as it was recorded.
    """
    table = load_recorded()
    if table is not None:
        take_from(table, todo)
        return
    for each in load_rubric().todos:
        if each.id == todo and (CHECKS / f"{each.mistakes}.py").exists():
            importlib.import_module(f"grader.checks.{each.mistakes}")


def take_from(table: Recorded, todo: str) -> None:
    for each in table.mistakes:
        if each.todo == todo:
            mistake(todo, each.id, each.meaning, about=each.about)(looked_up(each.answers))
    for about, answers in table.right.items():
        truth(about)(looked_up(answers))


def looked_up(answers: Answers) -> Model:
    """The model that gives these answers, and is undecided where there is none."""

    def model(*inputs: Any) -> Any:
        try:
            return answers[key(inputs)]
        except KeyError:
            raise Undecided from None

    return model


def named(todo: str, observations: Sequence[Observation]) -> Mistake | None:
    """The known mistake that explains every answer, or None.

    A student's copy sees less, so it names one only if no other explains as much.
    """
    load_known(todo)
    found = (each for each in known if each.todo == todo and explains(each, observations))
    first = next(found, None)
    if first is not None and load_recorded() is not None:
        return first if all(each.id == first.id for each in found) else None
    return first


def explains(each: Mistake, observations: Iterable[Observation]) -> bool:
    told_apart = False
    for seen in observations:
        if seen.about != each.about:
            continue
        try:
            predicted = each.model(*seen.inputs)
        except Undecided:
            continue
        if not alike(predicted, seen.answer):
            return False
        try:
            told_apart = told_apart or not alike(right[each.about](*seen.inputs), seen.answer)
        except Undecided:
            continue
    return told_apart


def alike(first: Any, second: Any, tolerance: float = 1e-6) -> bool:
    """Equal up to rounding, whatever the shape."""
    if isinstance(first, int | float) and isinstance(second, int | float):
        return math.isclose(first, second, rel_tol=tolerance, abs_tol=tolerance)
    if isinstance(first, tuple | list) and isinstance(second, tuple | list):
        return len(first) == len(second) and all(
            alike(a, b, tolerance) for a, b in zip(first, second, strict=True)
        )
    return bool(first == second)
